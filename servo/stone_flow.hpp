// One stone's motion being integrated, with its derivatives: the common ground of stone_motion_model and stone_path.
#pragma once

#include "servo/stone_motion_model.hpp"

namespace hogline::servo {

/// Below this speed a stone goes straight on with one deceleration: 0.05 mm to go.
inline constexpr double last_phase_mps = 0.006;

/// State and derivatives by the start's state and by the ice's factors.
struct StoneFlow {
  Eigen::Vector4d state = Eigen::Vector4d::Zero();  ///< x, y, vx, vy
  double spin_radps = 0.0;
  MotionJacobian by_start = MotionJacobian::Zero();
};

StoneFlow flow_from(const SlidingStone& stone);
double speed_mps(const StoneFlow& flow);
inline bool in_last_phase(const StoneFlow& flow) { return speed_mps(flow) < last_phase_mps; }

/// Rates of all of it. Precondition: not in the last phase.
StoneFlow rates_of(const StoneFlow& flow, const IceFactors& ice);

/// The step that is small against what changes: at most a quarter of the time in which the speed is lost, and not
/// beyond the moment at which the spin dies. Positive.
double step_s(const StoneFlow& flow, const IceFactors& ice, double longest_s);

/// A Runge-Kutta step of fourth order, of either sign. Precondition: not in the last phase.
StoneFlow stepped(const StoneFlow& flow, const IceFactors& ice, double dt_s);

/// From the last phase's beginning to rest.
double last_phase_s(const StoneFlow& flow, const IceFactors& ice);

/// The last phase in closed form; after last_phase_s() nothing moves. Precondition: dt_s >= 0, in the last phase.
StoneFlow in_last_phase_after(const StoneFlow& flow, const IceFactors& ice, double dt_s);

}  // namespace hogline::servo
