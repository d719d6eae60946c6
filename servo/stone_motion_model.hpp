// How a curling stone slides by itself: FCV1, the model of the Digital Curling simulator, with three factors that say
// in what an ice differs from it, and with its derivatives. Process model of the trackers and of the ice model.
//
// With v the speed and w the rate of turn: deceleration g (0.00200985 / (v + 0.06385782) + 0.00626286), turn of the
// velocity's direction sign(w) 0.00820 v^-0.8 rad/s, d|w|/dt = -0.025 / max(v, 0.001) rad/s2. Counter-clockwise curls
// left. The model knows no direction on the sheet: only the lateral acceleration is tied to the frame's x axis.
#pragma once

#include <Eigen/Core>

namespace hogline::servo {

/// In what an ice differs from FCV1.
struct IceFactors {
  double friction_scale = 1.0;    ///< of the deceleration; > 0
  double curl_gain = 1.0;         ///< of the turn of the direction
  double lateral_mps2 = 0.0;      ///< along the x axis of the frame in which the stone is given
  double spin_decay_scale = 1.0;  ///< of the loss of spin; >= 0
};

/// A stone on the ice. Frame: s, or e, as the user says; spin counter-clockwise from above positive. A stone whose spin
/// is 0 does not curl.
struct SlidingStone {
  double x_m = 0.0;
  double y_m = 0.0;
  double vx_mps = 0.0;
  double vy_mps = 0.0;
  double spin_radps = 0.0;
};

/// Derivatives of x, y, vx, vy (rows) by those at the start and by friction scale, curl gain and lateral acceleration
/// (columns). They do not follow the moment at which a spin dies.
using MotionJacobian = Eigen::Matrix<double, 4, 7>;

/// Where a stone has come to.
struct Slid {
  SlidingStone stone;
  MotionJacobian by_start = MotionJacobian::Zero();
  bool at_rest = false;
};

/// Where and when a stone comes to rest.
struct Rest {
  double x_m = 0.0;
  double y_m = 0.0;
  double after_s = 0.0;
  Eigen::Matrix<double, 2, 7> by_start = Eigen::Matrix<double, 2, 7>::Zero();
};

double speed_mps(const SlidingStone& stone);
double deceleration_mps2(double speed_mps, const IceFactors& ice);
/// Rate at which a spinning stone's direction turns; counter-clockwise positive. Precondition: speed_mps > 0.
double turn_radps(double speed_mps, double spin_radps, const IceFactors& ice);

/// Moves the stone by dt_s, which may be negative (a stone at rest then stays: when it stopped is not known).
/// Preconditions: all finite, friction_scale > 0.
Slid slide(const SlidingStone& stone, const IceFactors& ice, double dt_s);

/// Lets it go on until it rests.
Rest rest_of(const SlidingStone& stone, const IceFactors& ice);

}  // namespace hogline::servo
