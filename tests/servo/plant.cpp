#include "tests/servo/plant.hpp"

#include <algorithm>
#include <cmath>

#include "tests/servo/rig.hpp"

namespace hogline::servo::test {
namespace {

constexpr double tee_to_hog_m = 6.401;
constexpr int substeps = 5;
constexpr double frame_period_s = 1.0 / 60.0;
constexpr double arm_time_s = 1.0;
constexpr double grip_time_s = 0.2;
constexpr double spin_lag_s = 0.15;
constexpr double disturbance_time_s = 0.5;
constexpr double quick_stop_mps2 = 2.5;

double stone_deceleration_mps2(double speed_mps) {
  return 9.80665 * (0.00200985 / (speed_mps + 0.06385782) + 0.00626286);
}

}  // namespace

Plant::Plant(const ThrowerConfig& config, const PlantSettings& settings)
    : config_(config), settings_(settings), random_(settings.seed), now_(std::chrono::seconds(100)), next_look_(now_) {
  truth_.x_m = settings.x_m;
  truth_.y_m = tee_to_hog_m - settings.hog_distance_m;
  truth_.yaw_rad = settings.yaw_rad;
  truth_.hog_distance_m = settings.hog_distance_m;
}

double Plant::noise(double sigma) { return sigma * std::normal_distribution<double>()(random_); }

ThrowerObservation Plant::observe() {
  look();
  ThrowerObservation o;
  o.now = now_;
  const Stamp bus_stamp = now_ - std::chrono::milliseconds(2);
  o.wheels = WheelObservation{bus_stamp, left_radps_, right_radps_, !enabled_, enabled_};
  const double gyro_noise = settings_.gyro_noise_rad_per_sqrt_s / std::sqrt(seconds(period));
  o.gyro = GyroObservation{now_, truth_.yaw_rate_radps + settings_.gyro_bias_radps + noise(gyro_noise), true};
  o.gripper =
      GripperObservation{bus_stamp, !jaws_opened() && !set_down_, jaws_opened() || set_down_, spin_radps_, {}, {}};
  if (jaws_opened()) o.gripper->opening_since = release_stamp_;
  if (set_down_) o.gripper->opening_since = o.gripper->freed_at = set_down_;
  o.arm = ArmObservation{bus_stamp, arm_up_ <= 0.0, arm_up_ >= 1.0};
  o.near_view = near_view_;
  o.low_view = low_view_;
  return o;
}

void Plant::look() {
  if (now_ >= next_look_) {
    next_look_ += from_seconds(frame_period_s);
    std::uniform_real_distribution<double> uniform;
    const double latency_s =
        settings_.least_latency_s + uniform(random_) * (settings_.greatest_latency_s - settings_.least_latency_s);
    const bool missing = uniform(random_) < settings_.missing_share;
    const bool near = command_.camera == CameraOrder::near;
    if (!missing && command_.camera != CameraOrder::none) {
      under_way_.push_back({now_ + from_seconds(latency_s), near, percept(near)});
    }
  }
  for (auto late = under_way_.begin(); late != under_way_.end();) {
    if (late->arrives > now_) {
      ++late;
      continue;
    }
    (late->near ? near_view_ : low_view_) = late->percept;
    late = under_way_.erase(late);
  }
}

SheetPosePercept Plant::percept(bool near) {
  SheetPosePercept p;
  p.stamp = now_;
  const bool arm_right = near ? arm_up_ >= 1.0 : true;
  const bool visible =
      truth_.hog_distance_m < settings_.visible_from_m && truth_.hog_distance_m > settings_.visible_to_m;
  p.ok = arm_right && (near || visible);
  if (!p.ok) {
    p.reason = "the hog line is not in the picture";
    return p;
  }
  const double yaw_sigma = near ? settings_.near_yaw_sigma_rad : settings_.low_yaw_sigma_rad;
  const double hog_sigma = near ? settings_.place_sigma_m : settings_.low_hog_sigma_m;
  p.sigma = {settings_.place_sigma_m, hog_sigma, yaw_sigma};
  p.hog_distance_sigma_m = hog_sigma;
  p.hog_distance_m = truth_.hog_distance_m + noise(hog_sigma);
  p.body = {truth_.x_m + noise(settings_.place_sigma_m), tee_to_hog_m - p.hog_distance_m,
            (near ? settings_.near_yaw_gain * truth_.yaw_rad : truth_.yaw_rad + settings_.low_yaw_bias_rad) +
                noise(yaw_sigma)};
  return p;
}

void Plant::apply(const ThrowerCommand& command) {
  command_ = command;
  if (command.gripper.release && !release_ordered_) release_ordered_ = now_ + command.gripper.release_in;
  if (command.gripper.trial != trial_) try_jaws(command.gripper.trial);
  on_the_bus_.push_back(command.drive);
  if (on_the_bus_.size() > 2) on_the_bus_.pop_front();
  for (int i = 0; i < substeps; ++i) {
    move(seconds(period) / substeps);
    now_ += period / substeps;
    run_gripper();
  }
  const double arm_step = seconds(period) / arm_time_s;
  if (command.arm == ArmOrder::unfold) arm_up_ = std::min(1.0, arm_up_ + arm_step);
  if (command.arm == ArmOrder::fold) arm_up_ = std::max(0.0, arm_up_ - arm_step);
  spin_radps_ += (command.gripper.spin_radps - spin_radps_) * seconds(period) / spin_lag_s;
}

void Plant::drive_wheel(double& speed, double wanted, double dt_s) const {
  const bool resting = speed == 0.0;
  const double holding = resting ? settings_.breakaway_radps : settings_.breakaway_radps / 2.0;
  if (settings_.breakaway_radps > 0.0 && std::abs(wanted) < holding && std::abs(speed) < holding) {
    speed = 0.0;
    return;
  }
  speed += (wanted - speed) * dt_s / settings_.drive_lag_s;
}

void Plant::move(double dt_s) {
  const DriveCommand& order = on_the_bus_.front();
  enabled_ = order.order == DriveOrder::enable || order.order == DriveOrder::velocity;
  if (order.order == DriveOrder::velocity) {
    drive_wheel(left_radps_, order.left_radps, dt_s);
    drive_wheel(right_radps_, order.right_radps, dt_s);
  } else {
    const double change = quick_stop_mps2 / config_.base.wheel_radius_m * dt_s;
    for (double* wheel : {&left_radps_, &right_radps_}) *wheel -= std::clamp(*wheel, -change, change);
  }
  const double radius = config_.base.wheel_radius_m * (1.0 + settings_.radius_error);
  const double left = radius * (1.0 - settings_.radius_difference / 2.0) * left_radps_;
  const double right = radius * (1.0 + settings_.radius_difference / 2.0) * right_radps_;
  const double pull = settings_.grip_mps2 * dt_s;
  truth_.speed_mps += std::clamp((left + right) / 2.0 - truth_.speed_mps, -pull, pull);
  const double keep = std::exp(-dt_s / disturbance_time_s);
  wander_ = keep * wander_ + noise(std::sqrt(1.0 - keep * keep));
  truth_.yaw_rate_radps =
      (right - left) / config_.base.track_m + settings_.yaw_disturbance_radps * truth_.speed_mps / 2.0 * wander_;
  truth_.yaw_rad += truth_.yaw_rate_radps * dt_s;
  truth_.x_m -= truth_.speed_mps * std::sin(truth_.yaw_rad) * dt_s;
  truth_.y_m += truth_.speed_mps * std::cos(truth_.yaw_rad) * dt_s;
  truth_.hog_distance_m = tee_to_hog_m - truth_.y_m;
  if (!jaws_opened()) return;
  stone_speed_mps_ = std::max(0.0, stone_speed_mps_ - stone_deceleration_mps2(stone_speed_mps_) * dt_s);
  stone_gap_m_ += (stone_speed_mps_ - truth_.speed_mps) * dt_s;
  least_gap_m_ = std::min(least_gap_m_, stone_gap_m_);
}

void Plant::try_jaws(JawTrial trial) {
  trial_ = trial;
  if (trial == JawTrial::none) return;
  trial_ends_ = now_ + from_seconds(trial == JawTrial::open ? settings_.gripper_delay_s : grip_time_s) +
                from_seconds(noise(trial == JawTrial::open ? settings_.gripper_jitter_s : 0.0));
  if (trial == JawTrial::grip && !settings_.grips_again) trial_ends_.reset();
}

void Plant::run_gripper() {
  if (trial_ends_ && now_ >= *trial_ends_) {
    set_down_ = trial_ == JawTrial::open ? trial_ends_ : std::nullopt;
    trial_ends_.reset();
  }
  if (!release_ordered_ || jaws_opened() || now_ < *release_ordered_ + from_seconds(settings_.gripper_delay_s)) return;
  at_release_ = truth_;
  release_stamp_ = now_;
  stone_speed_mps_ = truth_.speed_mps;
}

}  // namespace hogline::servo::test
