// The thrower's base on ice: two driven wheels on one axle under b's origin, with a limit to their grip.
#pragma once

#include <cstdint>
#include <optional>
#include <random>

#include "hw/sim/scenario.hpp"
#include "hw/sim/truth.hpp"

namespace hogline::hw::sim {

/// What the drives do to the axes: the speed that they hold, or nothing for an axis that turns free.
struct AxisSpeeds {
  std::optional<double> left_radps;
  std::optional<double> right_radps;
};

/// Planar. A driven wheel pulls with whatever force keeps it rolling but for its creep, up to friction times the weight
/// that rests on it; beyond that it slips. Speeding up shifts weight from the runner to the wheels, braking the other
/// way. Wheels do not slide sideways and no weight shifts between them. Deterministic.
class RobotDynamics {
 public:
  RobotDynamics(const RobotScenario& scenario, std::uint64_t seed);

  /// Moves the robot by dt_s, a step of the order of a millisecond, carrying `load_kg` at `load_x_m` ahead of b.
  void step(const AxisSpeeds& axes, double load_kg, double load_x_m, double dt_s);

  /// Somebody sets it down there, at rest. What is wrong with it stays wrong.
  void put(const PlanarPose& pose);

  const PlanarPose& pose() const { return pose_; }  ///< e to b
  BodyTwist twist() const;
  double acceleration_mps2() const { return acceleration_mps2_; }
  double pitch_rad() const { return pitch_rad_; }  ///< positive when it looks down
  /// Of the axes as they really turn: as driven, or as a free wheel rolls.
  double left_radps() const { return left_radps_; }
  double right_radps() const { return right_radps_; }
  bool slipping() const { return slipping_; }  ///< at the limit of a wheel's grip; creep alone is no slipping

 private:
  struct Forces {
    double left_n = 0.0;
    double right_n = 0.0;
  };
  Forces grip(const AxisSpeeds& axes, double mass_kg, double inertia_kgm2, double dt_s);
  double wheel_weight_n() const;
  void wander(double dt_s);
  void move(double forward_before_mps, double dt_s);
  void rock(double dt_s);

  RobotScenario scenario_;
  double left_radius_m_;
  double right_radius_m_;
  double track_m_;
  std::mt19937_64 random_;
  std::normal_distribution<double> unit_normal_;

  PlanarPose pose_;
  double forward_mps_ = 0.0;
  double wheel_yaw_radps_ = 0.0;  ///< as the wheels make it
  double wander_ = 0.0;           ///< of unit variance
  double acceleration_mps2_ = 0.0;
  double pitch_rad_ = 0.0;
  double pitch_rate_radps_ = 0.0;
  double left_radps_ = 0.0;
  double right_radps_ = 0.0;
  bool slipping_ = false;
};

}  // namespace hogline::hw::sim
