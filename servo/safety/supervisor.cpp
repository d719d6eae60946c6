#include "servo/safety/supervisor.hpp"

#include <cmath>
#include <sstream>

#include "servo/unicycle.hpp"

namespace hogline::servo {
namespace {

constexpr double stone_to_hog_line_m = 0.145;  // a stone's centre, held, from the line's house-side edge
constexpr double resting_mps = 0.01;
constexpr double resting_radps = 0.02;
constexpr double moving_mps = 0.05;
constexpr int contradicting_looks = 10;
constexpr double unseen_travel_m = 0.3;  // no robot carries a stone further without ever having seen the line
constexpr double rotation_error = 1e-6;
constexpr double tee_to_hog_m = 6.401;  // a stone whose rim has not reached the near tee line is not in play

std::string beyond(const char* what, double is, double allowed) {
  std::ostringstream text;
  text.precision(4);
  text << what << ' ' << is << " (allowed " << allowed << ')';
  return text.str();
}

/// Cosine of the angle between the body's and the ice's normal; nothing when `eMc` holds no rotation.
std::optional<double> upright(const std::array<double, 16>& eMc, const std::array<double, 9>& cRb) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) {
      double dot = 0.0;
      for (std::size_t k = 0; k < 3; ++k) dot += eMc[4 * i + k] * eMc[4 * j + k];
      if (!(std::abs(dot - (i == j ? 1.0 : 0.0)) < rotation_error)) return std::nullopt;
    }
  }
  double cosine = 0.0;  // e's z row of eRc with b's z column of cRb
  for (std::size_t k = 0; k < 3; ++k) cosine += eMc[8 + k] * cRb[3 * k + 2];
  return cosine;
}

std::optional<std::string> tilted(const char* name, const std::optional<SheetPosePercept>& view,
                                  const std::array<double, 9>& cRb, double max_tilt_rad) {
  if (!view || !view->ok) return std::nullopt;
  const auto cosine = upright(view->eMc, cRb);
  if (!cosine) return std::string(name) + ": the camera's pose is no rotation";
  if (*cosine >= std::cos(max_tilt_rad)) return std::nullopt;
  return std::string(name) + ": " + beyond("the body is tilted; cosine", *cosine, std::cos(max_tilt_rad));
}

bool drives(const DriveCommand& drive) {
  return drive.order == DriveOrder::enable || drive.order == DriveOrder::velocity;
}

bool switch_held(const ThrowerObservation& o, Duration max_age) {
  if (!o.operator_switch || !o.operator_switch->held) return false;
  const Duration age = o.now - o.operator_switch->stamp;
  return age <= max_age && age >= -max_age;
}

std::optional<std::string> too_fast(const char* whose, const PlanarTwist& twist, const MotionLimits& limits,
                                    double margin) {
  const double forward = limits.max_speed_mps * (1.0 + margin);
  const double turn = limits.max_yaw_rate_radps * (1.0 + margin);
  // Written so that a value that is not a number fails.
  if (!(std::abs(twist.forward_mps) <= forward)) {
    return beyond((std::string(whose) + ": speed").c_str(), twist.forward_mps, forward);
  }
  if (!(std::abs(twist.yaw_rate_radps) <= turn)) {
    return beyond((std::string(whose) + ": rate of turn").c_str(), twist.yaw_rate_radps, turn);
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> Supervisor::arm(const ThrowerObservation& observation) {
  watch(observation);
  if (!switch_held(observation, config_.safety.operator_age)) return "not armed: the operator's switch is not held";
  if (!let_go_) return "not armed: the operator's switch has not been let go since the last stop";
  if (observation.device_error) return "not armed: device: " + *observation.device_error;
  if (observation.wheels && !at_rest_) return "not armed: the wheels turn, or are not known to stand";
  state_ = Supervision::armed;
  stop_ = {};
  agreement_ = TurnAgreement(config_.safety);
  place_ = PlaceBounds(config_.safety);
  jaws_ = JawWatch(config_.release);
  last_now_.reset();
  released_ = false;
  driven_ = false;
  return std::nullopt;
}

ThrowerCommand Supervisor::permit(const ThrowerObservation& observation, const ThrowerCommand& wanted, Duration dt) {
  watch(observation);
  if (state_ == Supervision::armed && active(wanted)) {
    stop_.set(judge(observation, wanted, dt));
    if (!stop_.reason() && wanted.gripper.release && !released_) {
      stop_.set(no_release(observation, wanted.gripper.release_in));
    }
    if (!stop_.reason() && wanted.gripper.trial != JawTrial::none) stop_.set(no_trial(observation, wanted));
  }
  last_now_ = observation.now;
  if (stop_.reason() && state_ == Supervision::armed) {
    state_ = Supervision::latched;
    let_go_ = false;
  }
  if (state_ != Supervision::armed) return only_stopping(wanted);

  ThrowerCommand permitted = wanted;
  jaws_.permitted(wanted.gripper.trial, observation.now);
  driven_ = driven_ || drives(wanted.drive);
  released_ = released_ || wanted.gripper.release;
  permitted.gripper.release = released_;
  return permitted;
}

// Before anything moves and after everything stands there is nothing to judge: nobody sends set-points, and the drives
// say so.
bool Supervisor::active(const ThrowerCommand& wanted) const {
  const bool opens = (wanted.gripper.release && !released_) || wanted.gripper.trial != JawTrial::none;
  return !at_rest_ || drives(wanted.drive) || wanted.arm != ArmOrder::hold || wanted.gripper.spin_radps != 0.0 || opens;
}

void Supervisor::watch(const ThrowerObservation& o) {
  let_go_ = let_go_ || (o.operator_switch && !o.operator_switch->held);
  jaws_.observe(o);
  if (!o.wheels) return;  // never heard of: not enabled by this program
  const Duration age = o.now - o.wheels->stamp;
  const PlanarTwist twist = twist_of({o.wheels->left_radps, o.wheels->right_radps}, config_.base);
  at_rest_ = age <= config_.ages.wheels && std::abs(twist.forward_mps) < resting_mps &&
             std::abs(twist.yaw_rate_radps) < resting_radps;
}

std::optional<std::string> Supervisor::judge(const ThrowerObservation& o, const ThrowerCommand& wanted, Duration dt) {
  if (last_now_ && o.now < *last_now_) return "time goes back";
  if (!switch_held(o, config_.safety.operator_age))
    return "the operator's switch was let go, or its state is not known";
  if (auto reason = bad_input(o, dt, needs(o, wanted), config_)) return reason;
  if (auto reason = tilted("near view", o.near_view, config_.alignment.near_cRb, config_.safety.max_tilt_rad)) {
    return reason;
  }
  if (auto reason = tilted("low view", o.low_view, config_.safety.low_cRb, config_.safety.max_tilt_rad)) return reason;
  take(o);
  if (auto reason = bad_motion(o, dt)) return reason;
  if (auto reason = bad_place(dt)) return reason;
  const bool still = !drives(wanted.drive) && wanted.arm == ArmOrder::hold && wanted.gripper.spin_radps == 0.0;
  if (jaws_.set_down() && !still) return "the stone has been set down and is not held: nothing may move";
  if (wanted.drive.order != DriveOrder::velocity) return std::nullopt;
  const PlanarTwist ordered = twist_of({wanted.drive.left_radps, wanted.drive.right_radps}, config_.base);
  return too_fast("ordered", ordered, config_.limits, config_.safety.speed_margin);
}

InputNeeds Supervisor::needs(const ThrowerObservation& o, const ThrowerCommand& wanted) const {
  const bool driving = drives(wanted.drive) || !at_rest_;
  const bool carrying = driving && !released_;
  const bool running = carrying && place_.forward_mps() > moving_mps;
  InputNeeds needs;
  needs.wheels = driving || o.wheels.has_value();
  needs.gyro = driving;
  needs.gripper = carrying;
  needs.holding = carrying;
  needs.low_view = running;
  return needs;
}

void Supervisor::take(const ThrowerObservation& o) {
  if (!o.wheels) return;
  place_.wheels(o.wheels->stamp, twist_of({o.wheels->left_radps, o.wheels->right_radps}, config_.base).forward_mps);
  if (o.near_view && o.near_view->ok) place_.look(*o.near_view);
  if (o.low_view && o.low_view->ok) place_.look(*o.low_view);
}

std::optional<std::string> Supervisor::bad_motion(const ThrowerObservation& o, Duration dt) {
  if (at_rest_ || !o.wheels || !o.gyro) return std::nullopt;
  const PlanarTwist wheels = twist_of({o.wheels->left_radps, o.wheels->right_radps}, config_.base);
  if (auto reason = too_fast("wheels", wheels, config_.limits, config_.safety.speed_margin)) return reason;
  const double most_radps = config_.limits.max_yaw_rate_radps * (1.0 + config_.safety.speed_margin) +
                            config_.safety.max_yaw_rate_disagreement_radps;
  if (!(std::abs(o.gyro->rate_radps) <= most_radps)) {
    return beyond("gyro: rate of turn", o.gyro->rate_radps, most_radps);
  }
  if (!released_ && place_.travelled_m() > config_.safety.max_travel_m) {
    return beyond("carried the stone for", place_.travelled_m(), config_.safety.max_travel_m);
  }
  return agreement_.judge(o.gyro->rate_radps, wheels.yaw_rate_radps, dt);
}

std::optional<bool> Supervisor::can_stop(Duration dt) const {
  const auto bounds = place_.now();
  if (!bounds) return std::nullopt;
  const double v = std::max(0.0, place_.forward_mps());
  const double ahead_m = bounds->nearest_m - config_.release.stone_x_m - stone_to_hog_line_m;
  const double reaction_s = config_.safety.reaction_s + seconds(dt);
  return ahead_m > v * reaction_s + v * v / (2.0 * config_.limits.max_deceleration_mps2);
}

// As long as the brakes can keep the stone before the line nothing is lost by going on. At the last such moment, and
// after it, the place must be known well enough for a release inside the window.
std::optional<std::string> Supervisor::bad_place(Duration dt) const {
  if (place_.contradictions() >= contradicting_looks) {
    return "the hog line as seen and the wheels contradict each other";
  }
  const auto bounds = place_.now();
  if (!bounds) {
    if (std::abs(place_.travelled_m()) <= unseen_travel_m) return std::nullopt;
    return "moves without having seen the hog line";
  }
  if (bounds->farthest_m < -config_.safety.max_overrun_m) {
    return beyond("beyond the hog line by", -bounds->farthest_m, config_.safety.max_overrun_m);
  }
  if (released_ || place_.forward_mps() <= moving_mps || *can_stop(dt)) return std::nullopt;
  if (place_.in_doubt()) return "no way back soon, and the looks and the wheels disagree on the place";
  if (bounds->half_width_m() > config_.release.tolerance_m) {
    return beyond("no way back soon, and the place is known only to", bounds->half_width_m(),
                  config_.release.tolerance_m);
  }
  if (bounds->nearest_m - config_.release.stone_x_m < stone_to_hog_line_m) {
    return beyond("the stone is held too near to the hog line:", bounds->nearest_m - config_.release.stone_x_m,
                  stone_to_hog_line_m);
  }
  return std::nullopt;
}

// The stone stands, and the robot with it: in the hack, without power, and with nothing else to do.
std::optional<std::string> Supervisor::no_trial(const ThrowerObservation& o, const ThrowerCommand& wanted) const {
  const std::string refused = "trial of the jaws refused: ";
  if (released_ || wanted.gripper.release) return refused + "the stone is released";
  if (wanted.gripper.trial == JawTrial::grip) return std::nullopt;  // on a stone that stands
  if (driven_ || drives(wanted.drive)) return refused + "the drives have been ordered to move since arming";
  if (!o.wheels || !at_rest_ || o.wheels->enabled) return refused + "the robot is not known to stand without power";
  if (wanted.arm != ArmOrder::hold || wanted.gripper.spin_radps != 0.0) return refused + "something else is to move";
  const auto bounds = place_.now();
  if (!bounds) return refused + "the place is not known";
  const double stone_m = bounds->nearest_m - config_.release.stone_x_m;
  if (stone_m >= tee_to_hog_m + stone_to_hog_line_m) return std::nullopt;
  return refused +
         beyond("the stone is not in the hack; metres from the hog line", stone_m, tee_to_hog_m + stone_to_hog_line_m);
}

std::optional<std::string> Supervisor::no_release(const ThrowerObservation& o, Duration release_in) const {
  const std::string refused = "release refused: ";
  if (!o.wheels || !o.gripper || !o.gripper->holding) return refused + "no stone is held";
  if (release_in < Duration::zero() || release_in > config_.ages.wheels)
    return refused + "its moment is not this period";
  const double from_s = std::max(0.0, seconds(o.now - o.wheels->stamp)) + seconds(release_in);
  const DelayBounds delay = jaws_.delay();
  const auto first = place_.ahead(from_s + delay.least_s, config_.limits.max_acceleration_mps2);
  const auto last = place_.ahead(from_s + delay.most_s, config_.limits.max_acceleration_mps2);
  if (!first || !last || place_.in_doubt()) return refused + "the place is not known";
  const HogBounds freed{last->nearest_m, first->farthest_m};
  const double plane_m = config_.release.hog_distance_m;
  const double tolerance_m = config_.release.tolerance_m;
  if (!(freed.nearest_m >= plane_m - tolerance_m)) {
    return refused + beyond("may be late by", plane_m - freed.nearest_m, tolerance_m);
  }
  if (!(freed.farthest_m <= plane_m + tolerance_m)) {
    return refused + beyond("may be early by", freed.farthest_m - plane_m, tolerance_m);
  }
  const double stone_m = freed.nearest_m - config_.release.stone_x_m;
  if (!(stone_m >= stone_to_hog_line_m)) {
    return refused + beyond("the stone may be too near to the hog line:", stone_m, stone_to_hog_line_m);
  }
  return std::nullopt;
}

// The controller may stop more gently in the end (off, once it stands); it may not go on.
ThrowerCommand Supervisor::only_stopping(const ThrowerCommand& wanted) const {
  ThrowerCommand command;
  command.camera = wanted.camera;
  command.gripper.release = released_;
  const bool stops = wanted.drive.order == DriveOrder::off || wanted.drive.order == DriveOrder::quick_stop;
  const bool brake = state_ == Supervision::latched && !at_rest_;
  command.drive.order = stops ? wanted.drive.order : brake ? DriveOrder::quick_stop : DriveOrder::off;
  return command;
}

}  // namespace hogline::servo
