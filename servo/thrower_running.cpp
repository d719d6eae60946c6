// The run and what comes after it: run, release, brake, stopped.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "servo/braking.hpp"
#include "servo/thrower_impl.hpp"

namespace hogline::servo {
namespace {

constexpr double tee_to_hog_m = 6.401;  // to the house-side edge (World Curling)
constexpr double resting_mps = 0.01;
constexpr double resting_radps = 0.02;
constexpr auto resting_time = std::chrono::milliseconds(200);
constexpr double scale_part = 0.2;
constexpr double delay_sigmas = 4.0;
constexpr double rate_after_slip = 0.6;  // of the profile's: 0.6 of its acceleration, 0.36 of its jerk
constexpr double line_sigmas = 3.0;      // of the place, kept clear of the hog line when braking with the stone

}  // namespace

ThrowerCommand Thrower::Impl::run(const ThrowerObservation& o, Duration dt) {
  ThrowerCommand command;
  command.camera = CameraOrder::low;
  command.gripper.spin_radps = spin_radps();
  if (!o.arm->folded) abort.set("arm: not folded (run)");

  advance_profile(o, dt);
  const HogDistanceEstimate hog = estimate.hog_distance().at(o.now);
  abort.set(out_of_sight(o.now, hog.hog_distance_m));
  const double to_release_s = (hog.hog_distance_m - config.release.hog_distance_m) / run_speed_mps();
  command.drive = drive(speed_setpoint_mps, o.now, to_release_s, dt);

  ReleaseOutlook view = outlook(o, dt);
  abort.set(last_chance_missed(view));
  view.wanted_speed_mps = run_speed_mps();
  const ReleaseDecision decision = decide_release(config.release, config.run, estimate.hog_distance(), view);
  diagnosis.predicted_release = decision.predicted;
  if (decision.verdict == ReleaseVerdict::never) abort.set("release: " + decision.reason);
  if (decision.verdict != ReleaseVerdict::release || abort.reason()) return command;

  release_ordered = true;
  release_at = o.now + decision.in;
  diagnosis.release_ordered = release_at;
  diagnosis.believed_delay_s = config.release.gripper_delay_s;
  command.gripper.release = true;
  command.gripper.release_in = decision.in;
  enter(ThrowerState::release, o.now);
  return command;
}

// Wheels that spin do not pull: the set-point waits until they roll again, and then rises more slowly.
void Thrower::Impl::advance_profile(const ThrowerObservation& o, Duration dt) {
  slip.wheels(o.wheels->stamp, estimate.odometry().forward_mps * estimate.hog_distance().at(o.now).scale);
  if (o.low_view && o.low_view->ok) {
    slip.look(o.low_view->stamp, o.low_view->hog_distance_m, o.low_view->hog_distance_sigma_m);
  }
  estimate.wheels_slip(slip.slipping());
  if (slip.slipping()) {
    profile_rate = rate_after_slip;
    ++diagnosis.slipping_periods;
  } else {
    profile_s += profile_rate * seconds(dt);
  }
  speed_setpoint_mps = profile->speed_mps(profile_s);
  const double left_m = (profile->distance_m() - profile->travelled_m(profile_s)) / profile_rate;
  const double at_hand_m = estimate.hog_distance().at(o.now).hog_distance_m - config.release.hog_distance_m;
  if (slip.ever() && profile_s < profile->duration_s() && left_m > at_hand_m) {
    abort.set("the wheels have slipped: the speed can not be reached before the release plane any more (run)");
  }
}

// A lens that is covered after a good look would else be noticed only when the wheels' word is worth nothing any more.
std::optional<std::string> Thrower::Impl::out_of_sight(Stamp now, double hog_distance_m) {
  const bool wanted = hog_distance_m <= config.run.sight_from_hog_m && hog_distance_m >= config.run.sight_to_hog_m;
  if (!wanted) return std::nullopt;
  if (!sight_wanted_since) sight_wanted_since = now;
  const Stamp seen = std::max(*sight_wanted_since, estimate.last_sight().value_or(Stamp{}));
  if (now - seen <= config.ages.low_sight) return std::nullopt;
  std::ostringstream text;
  text << "low view: the hog line must be in sight and has not been seen for " << seconds(now - seen)
       << " s; check lens, light and people before the camera (run)";
  return text.str();
}

ReleaseOutlook Thrower::Impl::outlook(const ThrowerObservation& o, Duration dt) const {
  ReleaseOutlook view;
  view.now = o.now;
  view.dt = dt;
  view.heading_rad = estimate.heading(o.now).yaw_rad;
  view.lateral_m = estimate.lateral().lateral_m();
  view.wanted_heading_rad = order.heading_rad;
  view.wanted_speed_mps = speed_setpoint_mps;
  view.spin_error_radps = o.gripper->spin_radps - spin_radps();
  return view;
}

// As long as the body can brake before the line, nothing is lost by going on. At the last such moment, and after it,
// going on must be worth it.
std::optional<std::string> Thrower::Impl::last_chance_missed(const ReleaseOutlook& view) const {
  const HogDistanceEstimate hog = estimate.hog_distance().at(view.now);
  const double ahead_m = stone_distance_m(hog.hog_distance_m, view.heading_rad, config.release) - stone_to_hog_line_m -
                         line_sigmas * hog.hog_distance_sigma_m;
  const double speed_mps = std::max(hog.speed_mps, speed_setpoint_mps);
  const double reaction_s = config.safety.reaction_s + seconds(view.dt);
  if (ahead_m > stopping_distance_m(speed_mps, config.limits.max_deceleration_mps2, reaction_s)) return std::nullopt;
  const auto reason = no_valid_release(config.release, config.run, estimate.hog_distance(), view);
  if (reason) return "no valid release ahead: " + *reason;
  return std::nullopt;
}

ThrowerCommand Thrower::Impl::release(const ThrowerObservation& o, Duration dt) {
  ThrowerCommand command;
  command.gripper.release = true;
  command.gripper.spin_radps = spin_radps();
  command.drive = drive(run_speed_mps(), o.now, 0.0, dt);
  if (!stone_is_free(o)) return command;
  released = true;
  const bool told = o.gripper->freed_at && *o.gripper->freed_at >= release_at;
  diagnosis.freed = freed_stone(told ? *o.gripper->freed_at : o.now, o);
  enter(ThrowerState::brake, o.now);
  return command;
}

// By the jaws' own report of their travel; where it does not come, when no jaws take longer. A body that brakes before
// that takes the stone's speed with it.
bool Thrower::Impl::stone_is_free(const ThrowerObservation& o) {
  const Stamp ordered = release_at;
  if (o.gripper->freed_at && *o.gripper->freed_at >= ordered) {
    diagnosis.measured_delay_s = seconds(*o.gripper->freed_at - ordered);
    diagnosis.freed_at_speed_mps = estimate.hog_distance().at(*o.gripper->freed_at).speed_mps /
                                   std::cos(estimate.heading(*o.gripper->freed_at).yaw_rad);
    return o.gripper->open;
  }
  const double unsure_s = std::hypot(config.release.gripper_delay_sigma_s, config.release.gripper_jitter_s);
  const double longest_s = config.release.gripper_delay_s + delay_sigmas * unsure_s;
  return o.gripper->open && o.now - ordered >= from_seconds(longest_s);
}

FreedStone Thrower::Impl::freed_stone(Stamp at, const ThrowerObservation& o) const {
  const HogDistanceEstimate hog = estimate.hog_distance().at(at);
  const double heading_rad = estimate.heading(at).yaw_rad;
  const LateralFilter& lateral = estimate.lateral();
  const double body_y_m = tee_to_hog_m - hog.hog_distance_m;
  const double body_x_m = lateral.line().x_at_m(body_y_m, lateral.lateral_m());
  return {.stamp = at,
          .x_m = body_x_m - config.release.stone_x_m * std::sin(heading_rad),
          .y_m = body_y_m + config.release.stone_x_m * std::cos(heading_rad),
          .speed_mps = hog.speed_mps / std::cos(heading_rad) - config.release.drag_mps,
          .heading_rad = heading_rad,
          .spin_radps = o.gripper->spin_radps};
}

ThrowerCommand Thrower::Impl::brake(const ThrowerObservation& o, Duration dt) {
  ThrowerCommand command;
  command.gripper.release = true;
  const double hog_m = estimate.hog_distance().at(o.now).hog_distance_m;
  const double braking = braking_mps2(speed_setpoint_mps, hog_m, config.release, config.limits);
  speed_setpoint_mps = std::max(0.0, speed_setpoint_mps - braking * seconds(dt));
  command.drive = speed_setpoint_mps > 0.0 ? drive(speed_setpoint_mps, o.now, 0.0, dt) : velocity({});
  at_rest = has_come_to_rest(o, dt);
  if (at_rest) enter(ThrowerState::stopped, o.now);
  return command;
}

ThrowerCommand Thrower::Impl::stopped() const {
  ThrowerCommand command;
  command.gripper.release = release_ordered;
  return command;
}

bool Thrower::Impl::has_come_to_rest(const ThrowerObservation& o, Duration dt) {
  const bool fresh = o.wheels && o.now - o.wheels->stamp <= config.ages.wheels;
  const PlanarTwist twist =
      fresh ? twist_of({o.wheels->left_radps, o.wheels->right_radps}, config.base) : PlanarTwist{};
  const bool rests =
      fresh && std::abs(twist.forward_mps) < resting_mps && std::abs(twist.yaw_rate_radps) < resting_radps;
  at_rest_for = rests ? at_rest_for + dt : Duration::zero();
  return at_rest_for >= resting_time;
}

// A true speed is asked for; the wheels are told what they will measure at it. What a look teaches of the odometry's
// scale is passed on gradually, as a small part of the allowed acceleration.
DriveCommand Thrower::Impl::drive(double true_speed_mps, Stamp now, double to_release_s, Duration dt) {
  const double scale = estimate.hog_distance().at(now).scale;
  const double change = scale_part * config.limits.max_acceleration_mps2 * seconds(dt) / run_speed_mps();
  driven_scale += std::clamp(scale - driven_scale, -change, change);
  const double lateral_m = estimate.lateral().lateral_m();
  const double heading_rad = estimate.heading(now).yaw_rad;
  const double yaw_rate_radps = tracking->step(lateral_m, heading_rad, true_speed_mps, to_release_s, dt);
  return velocity({true_speed_mps / driven_scale, yaw_rate_radps});
}

DriveCommand Thrower::Impl::velocity(const PlanarTwist& twist) const {
  const WheelPair wheels = wheels_of(twist, config.base);
  return {DriveOrder::velocity, wheels.left_radps, wheels.right_radps};
}

double Thrower::Impl::spin_radps() const {
  return order.curl == Curl::counter_clockwise ? order.spin_radps : -order.spin_radps;
}

}  // namespace hogline::servo
