#include "servo/safety/input_check.hpp"

#include <cmath>
#include <initializer_list>
#include <numbers>

namespace hogline::servo {
namespace {

// The gyro's range: beyond 375 deg/s a DSP-3000 is wrong though marked valid.
constexpr double gyro_range_radps = 375.0 * std::numbers::pi / 180.0;
// A wheel faster than this times what the greatest speed asks for is not a measurement.
constexpr double wheel_headroom = 2.0;
// A place further away than this from the tee is not on the sheet (hack to hack: 42 m).
constexpr double sheet_reach_m = 45.0;

bool finite(std::initializer_list<double> values) {
  for (const double value : values) {
    if (!std::isfinite(value)) return false;
  }
  return true;
}

/// Empty when fresh. A stamp from the future by more than the limit is as wrong as one from the past.
template <class Input>
std::optional<std::string> stale(const char* name, const std::optional<Input>& input, Stamp now, Duration limit) {
  if (!input) return std::string(name) + ": nothing has arrived";
  const Duration age = now - input->stamp;
  if (age > limit) return std::string(name) + ": stale";
  if (age < -limit) return std::string(name) + ": stamp lies in the future";
  return std::nullopt;
}

std::optional<std::string> bad_wheels(const WheelObservation& wheels, const ThrowerConfig& config) {
  const double bound = wheel_headroom * config.limits.max_speed_mps / config.base.wheel_radius_m;
  if (!finite({wheels.left_radps, wheels.right_radps})) return "wheels: speed is not finite";
  if (std::abs(wheels.left_radps) > bound || std::abs(wheels.right_radps) > bound) return "wheels: speed is impossible";
  return std::nullopt;
}

std::optional<std::string> bad_gyro(const GyroObservation& gyro) {
  if (!gyro.valid) return "gyro: marked invalid";
  if (!std::isfinite(gyro.rate_radps)) return "gyro: rate is not finite";
  if (std::abs(gyro.rate_radps) > gyro_range_radps) return "gyro: rate is out of range";
  return std::nullopt;
}

std::optional<std::string> bad_view(const char* name, const SheetPosePercept& view) {
  if (!view.ok) return std::nullopt;
  const std::string prefix = std::string(name) + ": ";
  const PlanarPose& body = view.body;
  const PlanarSigma& sigma = view.sigma;
  if (!finite({body.x_m, body.y_m, body.yaw_rad, view.hog_distance_m})) return prefix + "pose is not finite";
  for (const double part : {sigma.x_m, sigma.y_m, sigma.yaw_rad, view.hog_distance_sigma_m}) {
    if (!(std::isfinite(part) && part > 0.0)) return prefix + "sigma is not a positive number";
  }
  for (const double part : {body.x_m, body.y_m, view.hog_distance_m}) {
    if (std::abs(part) > sheet_reach_m) return prefix + "pose is not on the sheet";
  }
  if (std::abs(body.yaw_rad) > std::numbers::pi) return prefix + "yaw is out of range";
  return std::nullopt;
}

std::optional<std::string> too_old(const ThrowerObservation& o, const InputNeeds& needs, const AgeLimits& ages) {
  std::optional<std::string> reason;
  const auto check = [&](bool needed, const char* name, const auto& input, Duration limit) {
    if (!reason && needed) reason = stale(name, input, o.now, limit);
  };
  check(needs.wheels, "wheels", o.wheels, ages.wheels);
  check(needs.gyro, "gyro", o.gyro, ages.gyro);
  check(needs.gripper, "gripper", o.gripper, ages.gripper);
  check(needs.arm, "arm", o.arm, ages.arm);
  check(needs.near_view, "near view", o.near_view, ages.near_view);
  check(needs.low_view, "low view", o.low_view, ages.low_view);
  return reason;
}

}  // namespace

std::optional<std::string> bad_input(const ThrowerObservation& o, Duration dt, const InputNeeds& needs,
                                     const ThrowerConfig& config) {
  if (o.device_error) return "device: " + *o.device_error;
  if (dt <= Duration::zero()) return "control period: time does not go on";
  if (dt > config.ages.wheels) return "control period: too long";
  if (auto reason = too_old(o, needs, config.ages)) return reason;

  std::optional<std::string> reason;
  if (o.wheels) reason = bad_wheels(*o.wheels, config);
  if (!reason && o.gyro && (needs.gyro || o.gyro->valid)) reason = bad_gyro(*o.gyro);
  if (!reason && o.gripper && !std::isfinite(o.gripper->spin_radps)) reason = "gripper: spin is not finite";
  if (!reason && o.near_view) reason = bad_view("near view", *o.near_view);
  if (!reason && o.low_view) reason = bad_view("low view", *o.low_view);
  if (!reason && o.arm && o.arm->folded && o.arm->unfolded) reason = "arm: folded and unfolded at once";
  if (!reason && needs.enabled && !(o.wheels && o.wheels->enabled)) reason = "wheels: not enabled any more";
  if (!reason && needs.holding && !(o.gripper && o.gripper->holding && !o.gripper->open)) {
    reason = "gripper: the stone is not held";
  }
  return reason;
}

}  // namespace hogline::servo
