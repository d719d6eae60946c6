// The states before the run: unfold, rehearse, measure, align, fold.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "servo/refusal.hpp"
#include "servo/release_learning.hpp"
#include "servo/thrower_impl.hpp"

namespace hogline::servo {
namespace {

ThrowerCommand standing(ArmOrder arm, CameraOrder camera) {
  ThrowerCommand command;
  command.arm = arm;
  command.camera = camera;
  return command;
}

}  // namespace

ThrowerCommand Thrower::Impl::unfold(const ThrowerObservation& o) {
  const bool up = o.arm && o.arm->unfolded;
  const bool wheels = o.wheels && (o.wheels->ready || o.wheels->enabled);
  const bool gyro = o.gyro && o.gyro->valid;
  const bool stone = o.gripper && o.gripper->holding && !o.gripper->open;
  if (up && wheels && gyro && stone) {
    enter(config.release.rehearsals > 0 ? ThrowerState::rehearse : ThrowerState::measure, o.now);
  }
  return standing(ArmOrder::unfold, CameraOrder::none);  // a folded head sees darkness
}

// Nothing else moves, and the drives are without power. Where the robot stands must have been seen: the stone is set
// down in the hack, or not at all.
ThrowerCommand Thrower::Impl::rehearse(const ThrowerObservation& o) {
  ThrowerCommand command = standing(ArmOrder::hold, CameraOrder::near);
  if (!o.near_view || !o.near_view->ok || o.near_view->stamp < history.back().since) return command;
  const RehearsalStep step = rehearsal.step(*o.gripper, o.now);
  command.gripper.trial = step.order;
  if (!step.refused.empty()) abort.set("rehearsal: " + step.refused);
  if (!step.done) return command;

  const auto lesson = learn_rehearsed(prior_of(config.release), rehearsal.delays_s(), config.release.gripper_jitter_s);
  if (!lesson.refused.empty()) abort.set("rehearsal: " + lesson.refused);
  config.release = with_knowledge(config.release, lesson.knowledge);
  diagnosis.rehearsed_delays_s = rehearsal.delays_s();
  enter(ThrowerState::measure, o.now);
  return command;
}

ThrowerCommand Thrower::Impl::measure(const ThrowerObservation& o) {
  ThrowerCommand command = standing(ArmOrder::hold, CameraOrder::near);
  command.drive.order = o.wheels->enabled ? DriveOrder::velocity : DriveOrder::enable;
  if (o.near_view && o.near_view->stamp >= history.back().since) place.add(near_view(o));
  const bool rested = estimate.resting_s() >= seconds(config.measure.rest);
  if (!o.wheels->enabled || !rested || place.size() < config.measure.frames) return command;

  const StandingPlace here = *place.average();
  abort.set(run_does_not_fit(here.hog_distance_m));
  measured = here;
  estimate.start_heading(o.now, here);
  alignment.emplace(config.alignment, config.limits, order.heading_rad);
  place.clear();
  moved = o.now;
  enter(ThrowerState::align, o.now);
  return command;
}

double Thrower::Impl::turn_to_heading(Stamp now, Duration dt, bool& settled) {
  const HeadingEstimate heading = estimate.heading(now);
  const AlignmentStep turn = alignment->step(heading.yaw_rad, heading.rate_radps, dt);
  if (!turn.ok) abort.set("alignment: " + turn.reason);
  settled = turn.ok && turn.settled;
  return turn.ok ? turn.yaw_rate_radps : 0.0;
}

// Place and heading are looked at anew once the body stands: it may have shifted in the turn, and the near
// view's error differs with the direction it looks in. When the heading is not what the gyro said, the turn goes on.
ThrowerCommand Thrower::Impl::align(const ThrowerObservation& o, Duration dt) {
  ThrowerCommand command = standing(ArmOrder::hold, CameraOrder::near);
  bool settled = false;
  const double yaw_rate_radps = turn_to_heading(o.now, dt, settled);
  command.drive = velocity({0.0, yaw_rate_radps});
  if (yaw_rate_radps != 0.0) {
    moved = o.now;
    place.clear();
  }
  if (o.near_view->stamp > moved + from_seconds(config.alignment.stopping_lag_s)) place.add(near_view(o));
  if (config.alignment.method == AlignmentMethod::look_then_gyro) {
    if (settled) begin_line(o.now, *measured);
    return command;
  }
  if (!settled || place.size() < config.measure.frames) return command;

  const StandingPlace here = *place.average();
  estimate.start_heading(o.now, here);
  place.clear();
  const double error_rad = std::remainder(here.body.yaw_rad - order.heading_rad, 2.0 * std::numbers::pi);
  if (std::abs(error_rad) > std::max(config.alignment.tolerance_rad, here.sigma.yaw_rad)) return command;

  begin_line(o.now, here);
  return command;
}

SheetPosePercept Thrower::Impl::near_view(const ThrowerObservation& o) const {
  return without_yaw_bias(*o.near_view, config.alignment.near_yaw_bias);
}

void Thrower::Impl::begin_line(Stamp now, const StandingPlace& here) {
  abort.set(run_does_not_fit(here.hog_distance_m));
  diagnosis.yaw_after_alignment_rad = estimate.heading(now).yaw_rad;
  estimate.start_line(now, here, order);
  enter(ThrowerState::fold, now);
}

ThrowerCommand Thrower::Impl::fold(const ThrowerObservation& o, Duration dt) {
  ThrowerCommand command = standing(ArmOrder::fold, CameraOrder::low);
  bool settled = false;
  command.drive = velocity({0.0, turn_to_heading(o.now, dt, settled)});
  command.gripper.spin_radps = spin_radps();
  const bool spinning = std::abs(o.gripper->spin_radps - spin_radps()) <= config.run.spin_tolerance_radps;
  const bool sees = o.low_view && o.now - o.low_view->stamp <= config.ages.low_view;
  if (!o.arm->folded || !settled || !spinning || !sees) return command;

  abort.set(run_does_not_fit(estimate.hog_distance().at(o.now).hog_distance_m));
  profile.emplace(run_speed_mps(), config.limits.max_acceleration_mps2, config.limits.max_jerk_mps3);
  tracking.emplace(config.run, config.limits, order.heading_rad);
  enter(ThrowerState::run, o.now);
  return command;
}

std::optional<std::string> Thrower::Impl::run_does_not_fit(double hog_distance_m) const {
  const double needed_m = needed_run_m(config, run_speed_mps()) * std::cos(order.heading_rad);
  const double at_hand_m = hog_distance_m - config.release.hog_distance_m;
  const SpeedProfile ramp(run_speed_mps(), config.limits.max_acceleration_mps2, config.limits.max_jerk_mps3);
  const double lasts_s =
      ramp.duration_s() + (at_hand_m / std::cos(order.heading_rad) - ramp.distance_m()) / run_speed_mps();
  if (lasts_s > seconds(config.deadlines.run)) {
    return "the run would last " + std::to_string(lasts_s) + " s, longer than its deadline of " +
           std::to_string(seconds(config.deadlines.run)) + " s";
  }
  if (needed_m <= at_hand_m) return std::nullopt;
  return "the run does not fit: " + std::to_string(needed_m) + " m needed, " + std::to_string(at_hand_m) + " m at hand";
}

}  // namespace hogline::servo
