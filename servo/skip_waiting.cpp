#include <cmath>
#include <utility>

#include "servo/skip_impl.hpp"

namespace hogline::servo {
namespace {

constexpr double turning_radps = 0.02;

ViewGeometry view_of(const HeadGeometry& head, const PlanarPose& body, double tilt_sigma_rad) {
  const Eigen::Vector3d at = camera_pose(head, {}).bPc;
  const double c = std::cos(body.yaw_rad), s = std::sin(body.yaw_rad);
  // b's x axis is turned from e's y axis by yaw.
  return {body.x_m - s * at.x() - c * at.y(), body.y_m + c * at.x() - s * at.y(), at.z(), tilt_sigma_rad};
}

}  // namespace

SkipCommand Skip::Impl::boot(const SkipObservation& o) {
  if (head_lost) return stop(remarks.front(), o.now);
  if (o.now - since > config.deadlines.boot) return stop("the head's drives are not ready in time", o.now);
  if (o.head.enabled) enter(SkipState::look, o.now);
  return {.head = o.head.ready ? SkipCommand::Head::enable : SkipCommand::Head::none};
}

SkipCommand Skip::Impl::look(const SkipObservation& o) {
  if (head_lost) return stop(remarks.front(), o.now);
  if (config.known_body) {
    begin_watch(o.now, *config.known_body, {});
    enter(SkipState::aim, o.now);
    return {};
  }
  if (o.near_error) return stop(*o.near_error, o.now);
  if (o.now - since > config.deadlines.look) return stop("sheet and stones were not seen: " + last_reason, o.now);
  SkipCommand command{.near_wanted = true};
  if (!std::exchange(pointed, true)) {
    command.head = SkipCommand::Head::point;
    command.target = config.look;
    return command;
  }
  if (!stands(o) || !o.near || o.near->sheet.stamp < *head_stands_since + config.settle) return command;
  place.add(o.near->sheet);
  standing.add(o.near->stones);
  if (o.near->sheet.sheet_width_m) diagnosis.sheet_width_m = o.near->sheet.sheet_width_m;
  if (!o.near->sheet.ok) last_reason = o.near->sheet.reason;
  if (o.near->sheet.ok && !o.near->stones.ok) last_reason = o.near->stones.reason;
  if (place.size() >= config.look_frames && standing.looks() >= config.look_frames) {
    const StandingPlace seen = *place.average();
    begin_watch(o.now, seen.body, seen.sigma);
    pointed = false;
    enter(SkipState::aim, o.now);
  }
  return command;
}

// The head, and since when.
bool Skip::Impl::stands(const SkipObservation& o) {
  const bool still = o.head.on_target && std::abs(o.head.joints.pan_radps) < turning_radps &&
                     std::abs(o.head.joints.tilt_radps) < turning_radps;
  if (!still) head_stands_since.reset();
  if (still && !head_stands_since) head_stands_since = o.now;
  return still;
}

void Skip::Impl::begin_watch(Stamp now, const PlanarPose& body, const PlanarSigma& sigma) {
  diagnosis.body = body;
  diagnosis.body_sigma = sigma;
  diagnosis.standing = standing.stones();
  CollisionWatchConfig c = config.watch;
  c.world.ice = ice;
  c.world.expected_spin_radps = config.expected_spin_radps;
  c.world.sheet_width_m = diagnosis.sheet_width_m;
  c.views[static_cast<std::size_t>(View::far)] = view_of(config.aiming.head, body, config.far_tilt_sigma_rad);
  c.views[static_cast<std::size_t>(View::near)] = view_of(config.near_head, body, config.near_tilt_sigma_rad);
  watch.emplace(c, now, diagnosis.standing);
  pose_seen = far_seen = now;
}

SkipCommand Skip::Impl::aim(const SkipObservation& o) {
  if (head_lost) return stop(remarks.front(), o.now);
  if (o.now - since > config.deadlines.aim) return stop("the head does not reach where it shall wait", o.now);
  const auto q = aiming.point_at(config.wait_at.x_m, config.wait_at.y_m, *diagnosis.body);
  if (!q) return stop("where the stone will come from is out of the head's reach", o.now);
  SkipCommand command{.near_wanted = true, .far_wanted = true};
  if (!std::exchange(pointed, true)) {
    command.head = SkipCommand::Head::point;
    command.target = *q;
    return command;
  }
  if (watch->at(o.now).thrown())
    enter(SkipState::follow, o.now);
  else if (o.head.on_target)
    enter(SkipState::wait, o.now);
  return command;
}

SkipCommand Skip::Impl::wait(const SkipObservation& o) {
  if (head_lost) return stop(remarks.front(), o.now);
  if (o.now - since > config.deadlines.wait) return stop("no stone was seen to be thrown", o.now);
  if (watch->at(o.now).thrown()) {
    pose_seen = far_seen = o.now;
    enter(SkipState::follow, o.now);
  }
  return {.near_wanted = true, .far_wanted = true};
}

}  // namespace hogline::servo
