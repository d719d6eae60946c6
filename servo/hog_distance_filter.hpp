// Distance to the hog line while running: wheel odometry carries it, low views correct it at their own stamps.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "servo/delayed_fusion.hpp"
#include "servo/thrower_config.hpp"

namespace hogline::servo {

struct HogDistanceEstimate {
  double hog_distance_m = 0.0;  ///< of b's origin from the hog line's house-side edge, along e's y
  double hog_distance_sigma_m = 0.0;
  double speed_mps = 0.0;  ///< towards the line, along e's y
  double speed_sigma_mps = 0.0;
  double acceleration_mps2 = 0.0;  ///< along e's y, of the last tenth of a second
  double acceleration_sigma_mps2 = 0.0;
  double scale = 1.0;  ///< true over measured distance, at this acceleration
  double scale_sigma = 0.0;
};

/// When a plane will be crossed, if the body keeps its present acceleration.
struct Crossing {
  Stamp stamp{};
  double sigma_s = 0.0;               ///< with what place, speed and acceleration may be off until then
  double hog_distance_sigma_m = 0.0;  ///< of the body when it crosses
};

/// Extended Kalman filter of distance, odometry scale and creep: wheels that pull turn a little faster than they roll,
/// in proportion to the acceleration, and what the scale seems to be while speeding up is not what it is afterwards.
/// Speed and acceleration are the wheels', smoothed by an alpha-beta filter (Kalata 1984): an acceleration that changes
/// with 3 m/s3 is 0.15 m/s2 behind. Looks that go on falling to one side say that the wheels have slipped: the distance
/// is then less sure, and soon found again. So do looks that are refused one after the other and agree with each other:
/// what no slip explains stays refused.
class HogDistanceModel {
 public:
  struct State {
    double hog_distance_m = 0.0;
    double scale = 1.0;         ///< true over measured distance, of wheels that do not pull
    double creep_s2pm = 0.0;    ///< by so much less per acceleration
    double odometry_mps = 0.0;  ///< measured, along e's y, in force since the last input
    double speed_mps = 0.0;     ///< the same, smoothed
    double acceleration_mps2 = 0.0;
    bool slipping = false;
    double surprise = 0.0;      ///< mean of the last looks' normalised innovations
    int refused = 0;            ///< looks in a row that were gated and agree with each other,
    double refused_by_m = 0.0;  ///< the last of them by so much
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of distance, scale and creep

    double pulled_scale() const { return scale - creep_s2pm * acceleration_mps2; }
    double pulled_scale_variance() const;
  };
  struct Input {
    double odometry_mps = 0.0;
    bool slipping = false;  ///< the wheels spin: their way says little, and nothing of their scale
  };
  struct Measurement {
    double hog_distance_m = 0.0;
    double sigma_m = 0.0;
    double counts_as =
        1.0;  ///< of how many independent looks, once others have told the same; the gate takes it for one
  };

  explicit HogDistanceModel(const OdometryConfig& config) : config_(config) {}
  void hold(State& state, double dt_s) const;
  void drive(State& state, double dt_s, const Input& input) const;
  bool correct(State& state, const Measurement& measurement) const;

 private:
  void propagate(State& state, double travelled_m) const;
  static bool insisted_on(State& state, double innovation, double sigma_m);
  OdometryConfig config_;
};

class HogDistanceFilter {
 public:
  /// Starts at rest at a measured place (near view). Precondition: finite, sigma_m > 0.
  HogDistanceFilter(const OdometryConfig& config, Stamp start, double hog_distance_m, double sigma_m);

  /// Wheel odometry: measured forward speed and the heading it is run at.
  void odometry(Stamp stamp, double forward_mps, double yaw_rad, bool slipping = false);

  /// A hog distance seen at `stamp`, however late. `counts_as`: looks that share an error of n looks' length count as
  /// one n-th of an independent look each, but for the first. Precondition: finite, sigma_m > 0, 0 < counts_as <= 1.
  Fusion hog_distance(Stamp stamp, double hog_distance_m, double sigma_m, double counts_as = 1.0);

  /// Past the last measurement this is dead reckoning, and its sigma says so.
  HogDistanceEstimate at(Stamp stamp) const;

  /// When the body's origin is at this distance from the line; nothing when it does not move towards the line, or
  /// brakes so hard that it comes to rest before the plane. A plane that lies behind has a stamp before `now`.
  std::optional<Crossing> crossing(Stamp now, double plane_hog_distance_m) const;

  int gated() const { return gated_; }
  int gated_in_a_row() const { return gated_in_a_row_; }

 private:
  HogDistanceModel model_;
  DelayedFusion<HogDistanceModel> fusion_;
  int gated_ = 0;
  int gated_in_a_row_ = 0;
};

}  // namespace hogline::servo
