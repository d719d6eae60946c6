// A throw's trajectory by shooting: the start and the ice for which the predicted way runs through what was seen.
//
// Least squares over all looks with their covariances, the ice's prior, the throw's own deviation of friction, and for
// every view one error that all its looks share. Robust: looks that nothing can explain lose their weight.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "servo/stone_motion_model.hpp"
#include "vision/percepts/stamp.hpp"
#include "vision/percepts/stones.hpp"

namespace hogline::servo {

/// The cameras that follow a stone.
enum class View { far, near };
inline constexpr int view_count = 2;

/// The error that all looks of a view share: its camera is tilted a little otherwise than thought. It moves a stone
/// along the ray by range^2 / height for each radian.
struct SharedTilt {
  double camera_x_m = 0.0;
  double camera_y_m = 0.0;
  double sigma_per_m = 0.0;  ///< one sigma of the tilt over the camera's height; 0: nothing is shared

  /// Where one sigma moves a stone that is here. To be asked for the place as estimated, not as looked at: a look's own
  /// error would go with its square into what is learnt of the tilt.
  Eigen::Vector2d at(double x_m, double y_m) const {
    const Eigen::Vector2d ray(x_m - camera_x_m, y_m - camera_y_m);
    return ray * ray.norm() * sigma_per_m;
  }
};

/// One look at the thrown stone.
struct TrackLook {
  Stamp stamp{};
  double x_m = 0.0;
  double y_m = 0.0;
  PlaceCovariance covariance;  ///< of this look alone
  View view = View::near;
  SharedTilt tilt;
};

/// A stone's looks from its release, or from when it was first seen, up to its first collision or to rest.
struct ThrowTrack {
  std::vector<TrackLook> looks;  ///< by their stamps
  double spin_radps = 0.0;       ///< at the first look, counter-clockwise positive; 0: does not curl
};

/// What is known of the ice, in one frame; saved and loaded as it is.
struct IceEstimate {
  double friction_scale = 1.0;
  double curl_gain = 1.0;
  double lateral_mps2 = 0.0;           ///< along the frame's x axis
  std::array<double, 9> covariance{};  ///< of the three, row by row
  int throws = 0;                      ///< how many it was learnt from

  IceFactors factors() const { return {friction_scale, curl_gain, lateral_mps2}; }
};

struct ThrowFitConfig {
  double throw_friction_sigma = 0.005;  ///< share by which a throw's friction differs from its ice's
  double suspicious_sigmas = 3.0;       ///< looks beyond it weigh less
  double rejected_sigmas = 6.0;         ///< looks beyond it weigh nothing
  int least_looks = 12;
  double least_way_m = 1.0;  ///< between the first and the last look
};

/// Order of the seven: x, y, vx, vy at the start, then the throw's friction scale, curl gain, lateral acceleration.
struct ThrowFit {
  bool ok = false;
  std::string reason;  ///< why not, when !ok; then nothing below must be used
  Stamp start{};       ///< of the first look
  SlidingStone stone;  ///< at the start
  IceFactors ice;      ///< of this throw
  Eigen::Matrix<double, 7, 7> covariance = Eigen::Matrix<double, 7, 7>::Zero();
  IceEstimate learnt;  ///< of the ice: prior and throw together, without the throw's own deviation
  std::array<double, view_count> shared_sigmas{};  ///< each view's shared error, in its sigmas
  double residual = 0.0;  ///< RMS of the looks' normalised residuals: 1 when the covariances are honest
  int used = 0;
  int rejected = 0;
};

/// Looks more scattered than their covariances say widen the answer's covariance by as much.
ThrowFit fit_throw(const ThrowTrack& track, const IceEstimate& prior, const ThrowFitConfig& config);

}  // namespace hogline::servo
