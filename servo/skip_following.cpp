#include "servo/skip_impl.hpp"

namespace hogline::servo {
namespace {

constexpr Duration pose_refresh = std::chrono::milliseconds(500);
constexpr Duration quiet_after = std::chrono::milliseconds(500);  // after the last stone came to rest

PlaceCovariance place_covariance(const WorldStone& stone) {
  const MotionCovariance& c = stone.motion.covariance;
  return {c(0, 0), c(0, 1), c(1, 1)};
}

ExpectedStone expectation(const WorldStone& stone, Stamp now) {
  const SlidingStone& s = stone.motion.stone;
  return {now, s.x_m, s.y_m, s.vx_mps, s.vy_mps, place_covariance(stone)};
}

}  // namespace

SkipCommand Skip::Impl::follow(const SkipObservation& o, Duration dt) {
  note_world(o.now);
  const bool over = watch->over(o.now, config.ages.stone);
  if (!over) quiet_since.reset();
  if (over && !quiet_since) quiet_since = o.now;
  const bool late = o.now - since > config.deadlines.follow;
  if (late) remarks.push_back("something still moved when the time was over");
  if (late || (quiet_since && o.now - *quiet_since > quiet_after)) {
    finish(o.now);
    return {.head = SkipCommand::Head::stop};
  }
  return track(o, dt);
}

SkipCommand Skip::Impl::track(const SkipObservation& o, Duration dt) {
  SkipCommand command{.near_wanted = near_wanted(o.now), .far_wanted = !head_lost};
  if (head_lost) return command;
  const HeadAimingCommand rates = aiming.step(o.now, dt, o.head.joints, target(o.now), *diagnosis.body);
  if (!rates.ok) {
    lose_head(rates.reason);
    return command;
  }
  command.head = SkipCommand::Head::track;
  command.pan_radps = rates.pan_radps;
  command.tilt_radps = rates.tilt_radps;
  diagnosis.off_axis_rad = rates.off_axis_rad;
  diagnosis.head_limited = rates.limited;
  return command;
}

GazeTarget Skip::Impl::target(Stamp stamp) const {
  if (last_target) return {stamp, last_target->x_m, last_target->y_m, last_target->vx_mps, last_target->vy_mps};
  return {stamp, config.wait_at.x_m, config.wait_at.y_m, 0.0, 0.0};
}

// The sheet's pose now and then, and all pictures once something runs in the near view.
bool Skip::Impl::near_wanted(Stamp now) const {
  const double near_y_m = config.hand_over_y_m + 1.5 * config.hand_over_overlap_m;
  return (diagnosis.thrown && diagnosis.thrown->y_m < near_y_m) || head_lost || now - pose_seen > pose_refresh;
}

void Skip::Impl::note_world(Stamp now) {
  const World world = watch->at(now);
  diagnosis.expected.clear();
  for (const WorldStone& s : world.stones) {
    if (s.phase != StonePhase::gone) diagnosis.expected.push_back(expectation(s, now));
  }
  diagnosis.thrown.reset();
  diagnosis.stop.reset();
  const WorldStone* thrown = world.thrown();
  if (!thrown) return;
  const SlidingStone& at = thrown->motion.stone;
  diagnosis.thrown = at;
  diagnosis.thrown_covariance = place_covariance(*thrown);
  const bool gone = thrown->phase == StonePhase::gone;
  if (gone && last_target) {
    last_target->vx_mps = last_target->vy_mps = 0.0;
    return;
  }
  last_target = GazeTarget{now, at.x_m, at.y_m, at.vx_mps, at.vy_mps};
  if (thrown->phase != StonePhase::moving || thrown->motion.at_rest()) return;
  diagnosis.stop = predict_stop(at, thrown->motion.ice, motion_covariance(thrown->motion));
}

}  // namespace hogline::servo
