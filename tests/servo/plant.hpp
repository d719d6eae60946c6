// A kinematic robot on a sheet, for closed-loop tests: wheels with lag, dead time, radius errors and stiction, a gyro
// with bias, cameras whose looks are noisy, late and sometimes missing, a gripper with a delay, an arm. Seeded.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <random>

#include "servo/command.hpp"
#include "servo/observation.hpp"
#include "servo/thrower_config.hpp"

namespace hogline::servo::test {

struct PlantSettings {
  std::uint64_t seed = 1;
  double x_m = 0.05;
  double hog_distance_m = 9.8;
  double yaw_rad = 0.0;
  double radius_error = 0.01;          ///< true radius over the configured one, less one
  double radius_difference = 0.0;      ///< right less left, over the radius
  double yaw_disturbance_radps = 0.0;  ///< of ruts and pebble at 2 m/s, in proportion to the speed; lasts 0.5 s
  double drive_lag_s = 0.03;
  double breakaway_radps = 0.0;  ///< a resting wheel does not follow a command slower than this
  double gyro_bias_radps = 0.0;
  double gyro_noise_rad_per_sqrt_s = 3e-5;
  double near_yaw_sigma_rad = 0.0005;
  double near_yaw_gain = 1.0;  ///< seen over true: an error that grows with the angle
  double low_yaw_bias_rad = 0.0;
  double low_yaw_sigma_rad = 0.002;
  double low_hog_sigma_m = 0.010;
  double place_sigma_m = 0.003;
  double missing_share = 0.1;
  double least_latency_s = 0.010;
  double greatest_latency_s = 0.040;
  double visible_from_m = 6.5;  ///< hog distances the low view sees the line at
  double visible_to_m = 0.68;
  double gripper_delay_s = 0.075;
  double gripper_jitter_s = 0.0;  ///< of the trials before the run
  bool grips_again = true;        ///< after a trial
  double grip_mps2 = 100.0;       ///< the body gains and loses speed no faster than this; beyond it the wheels spin
};

struct PlantTruth {
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;
  double speed_mps = 0.0;
  double yaw_rate_radps = 0.0;
  double hog_distance_m = 0.0;
};

class Plant {
 public:
  Plant(const ThrowerConfig& config, const PlantSettings& settings);

  /// What the devices report at now().
  ThrowerObservation observe();
  /// Applies a command for one control period.
  void apply(const ThrowerCommand& command);

  Stamp now() const { return now_; }
  const PlantTruth& truth() const { return truth_; }
  const std::optional<PlantTruth>& at_release() const { return at_release_; }
  Stamp release_stamp() const { return release_stamp_; }
  /// The least distance between the robot and the stone since it was let go, beyond the held one's; negative: touched.
  double least_gap_m() const { return least_gap_m_; }
  bool jaws_opened() const { return at_release_.has_value(); }
  bool set_down() const { return set_down_.has_value(); }

 private:
  void move(double dt_s);
  void drive_wheel(double& speed, double wanted, double dt_s) const;
  void look();
  SheetPosePercept percept(bool near);
  void run_gripper();
  void try_jaws(JawTrial trial);
  double noise(double sigma);

  ThrowerConfig config_;
  PlantSettings settings_;
  std::mt19937_64 random_;
  Stamp now_;
  PlantTruth truth_;
  double wander_ = 0.0;
  double left_radps_ = 0.0;
  double right_radps_ = 0.0;
  ThrowerCommand command_;
  std::deque<DriveCommand> on_the_bus_;
  bool enabled_ = false;
  double arm_up_ = 0.0;  // 0 folded .. 1 unfolded
  double spin_radps_ = 0.0;
  std::optional<Stamp> release_ordered_;
  Stamp release_stamp_{};
  JawTrial trial_ = JawTrial::none;
  std::optional<Stamp> trial_ends_;
  std::optional<Stamp> set_down_;
  std::optional<PlantTruth> at_release_;
  double stone_gap_m_ = 0.0;
  double stone_speed_mps_ = 0.0;
  double least_gap_m_ = 0.0;
  Stamp next_look_{};
  struct Late {
    Stamp arrives;
    bool near;
    SheetPosePercept percept;
  };
  std::deque<Late> under_way_;
  std::optional<SheetPosePercept> near_view_;
  std::optional<SheetPosePercept> low_view_;
};

}  // namespace hogline::servo::test
