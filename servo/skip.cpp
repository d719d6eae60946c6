#include "servo/skip.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "servo/place_average.hpp"
#include "servo/standing_stones.hpp"

namespace hogline::servo {
namespace {

constexpr double steering_gate_m = 0.15;  // a far look this near to the estimate may steer the head, and
constexpr double steering_sigmas = 3.0;   // within these
constexpr double turning_radps = 0.02;
constexpr Duration pose_refresh = std::chrono::milliseconds(500);
constexpr Duration quiet_after = std::chrono::milliseconds(500);  // after the last stone came to rest

Eigen::Vector3d in_camera(const std::array<double, 16>& m, const Eigen::Vector3d& eP) {
  Eigen::Matrix3d eRc;
  eRc << m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10];
  return eRc.transpose() * (eP - Eigen::Vector3d(m[3], m[7], m[11]));
}

ViewGeometry view_of(const HeadGeometry& head, const PlanarPose& body, double tilt_sigma_rad) {
  const Eigen::Vector3d at = camera_pose(head, {}).bPc;
  const double c = std::cos(body.yaw_rad), s = std::sin(body.yaw_rad);
  // b's x axis is turned from e's y axis by yaw.
  return {body.x_m - s * at.x() - c * at.y(), body.y_m + c * at.x() - s * at.y(), at.z(), tilt_sigma_rad};
}

double gate_of(const WorldStone& stone) {
  const MotionCovariance& c = stone.motion.covariance;
  return steering_gate_m + steering_sigmas * std::sqrt(c(0, 0) + c(1, 1));
}

StoneSighting expectation(const WorldStone& stone) {
  StoneSighting at;
  at.x_m = stone.motion.stone.x_m, at.y_m = stone.motion.stone.y_m;
  const MotionCovariance& c = stone.motion.covariance;
  at.covariance = {c(0, 0), c(0, 1), c(1, 1)};
  at.team = stone.team;
  return at;
}

}  // namespace

const char* to_string(SkipState state) {
  switch (state) {
    case SkipState::boot:
      return "boot";
    case SkipState::look:
      return "look";
    case SkipState::aim:
      return "aim";
    case SkipState::wait:
      return "wait";
    case SkipState::follow:
      return "follow";
    case SkipState::done:
      return "done";
    case SkipState::stopped:
      return "stopped";
  }
  return "unknown";
}

struct Skip::Impl {
  Impl(const SkipConfig& skip_config, const IceEstimate& ice_estimate, Stamp start)
      : config(skip_config), ice(ice_estimate), aiming(config.aiming), since(start) {}

  SkipCommand step(const SkipObservation& o, Duration dt);
  SkipCommand boot(const SkipObservation& o);
  SkipCommand look(const SkipObservation& o);
  SkipCommand aim(const SkipObservation& o);
  SkipCommand wait(const SkipObservation& o, Duration dt);
  SkipCommand follow(const SkipObservation& o, Duration dt);

  void enter(SkipState next, Stamp now);
  SkipCommand stop(std::string why, Stamp now);
  void finish(Stamp now);
  void lose_head(std::string why);
  void lose_sight(std::string why);
  void supervise(const SkipObservation& o);
  void begin_watch(Stamp now, const PlanarPose& body, const PlanarSigma& sigma);
  void take_in(const SkipObservation& o);
  void take_near(const NearSight& near);
  void take_far(const FarPercept& far);
  void steer(const FarPercept& far);
  bool stands_elsewhere(const PlanarPose& seen) const;
  GazeTarget target(Stamp stamp) const;
  SkipCommand track(const SkipObservation& o, Duration dt);
  bool near_wanted(Stamp now) const;
  void note_world(Stamp now);

  SkipConfig config;
  IceEstimate ice;
  HeadAiming aiming;
  SkipState state = SkipState::boot;
  Stamp since;

  PlaceAverage place;
  StandingStones standing;
  std::string last_reason = "no picture came";
  std::optional<Stamp> head_stands_since;
  bool pointed = false;

  std::optional<CollisionWatch> watch;
  std::optional<GazeTarget> last_target;  // where the thrown stone was last, once it is gone or at rest
  Stamp pose_seen{};
  Stamp far_seen{};
  std::optional<Stamp> quiet_since;
  bool head_lost = false;
  bool sight_lost = false;
  std::vector<std::string> remarks;
  SkipDiagnosis diagnosis;
  SkipReport report;
};

Skip::Skip(const SkipConfig& config, const IceEstimate& ice, Stamp start)
    : impl_(std::make_unique<Impl>(config, ice, start)) {}
Skip::~Skip() = default;
Skip::Skip(Skip&&) noexcept = default;
Skip& Skip::operator=(Skip&&) noexcept = default;

SkipCommand Skip::step(const SkipObservation& observation, Duration dt) { return impl_->step(observation, dt); }
void Skip::conclude(Stamp now) {
  if (finished()) return;
  if (!impl_->watch || !impl_->watch->at(now).thrown()) {
    impl_->stop(
        impl_->watch ? "no stone was seen to be thrown" : "sheet and stones were not seen: " + impl_->last_reason, now);
    return;
  }
  impl_->remarks.push_back("it ended before all lay still");
  impl_->finish(now);
}

SkipState Skip::state() const { return impl_->state; }
bool Skip::finished() const { return impl_->state == SkipState::done || impl_->state == SkipState::stopped; }
const SkipDiagnosis& Skip::diagnosis() const { return impl_->diagnosis; }
const CollisionWatch* Skip::watch() const { return impl_->watch ? &*impl_->watch : nullptr; }
const SkipReport& Skip::report() const { return impl_->report; }

SkipCommand Skip::Impl::step(const SkipObservation& o, Duration dt) {
  if (state == SkipState::done || state == SkipState::stopped) return {.head = SkipCommand::Head::stop};
  supervise(o);
  if (watch) take_in(o);
  SkipCommand command;
  switch (state) {
    case SkipState::boot:
      command = boot(o);
      break;
    case SkipState::look:
      command = look(o);
      break;
    case SkipState::aim:
      command = aim(o);
      break;
    case SkipState::wait:
      command = wait(o, dt);
      break;
    case SkipState::follow:
      command = follow(o, dt);
      break;
    case SkipState::done:
    case SkipState::stopped:
      break;
  }
  if (head_lost && state != SkipState::boot) command.head = SkipCommand::Head::stop;
  return command;
}

void Skip::Impl::enter(SkipState next, Stamp now) {
  state = next;
  since = now;
}

SkipCommand Skip::Impl::stop(std::string why, Stamp now) {
  report.ok = false;
  report.reason = report.result.reason = std::move(why);
  report.remarks = remarks;
  enter(SkipState::stopped, now);
  return {.head = SkipCommand::Head::stop};
}

void Skip::Impl::finish(Stamp now) {
  report.result = result_of(watch->at(now), config.expected_spin_radps, watch->config().world, config.fit);
  report.remarks = remarks;
  report.ok = report.result.ok && remarks.empty();
  report.reason = !report.result.ok ? report.result.reason : remarks.empty() ? "" : remarks.front();
  enter(SkipState::done, now);
}

void Skip::Impl::lose_head(std::string why) {
  if (head_lost) return;
  head_lost = true;
  remarks.push_back("the head was stopped: " + std::move(why));
}

void Skip::Impl::lose_sight(std::string why) {
  if (sight_lost) return;
  sight_lost = true;
  lose_head(why);
  remarks.push_back("nothing was taken in after this: " + std::move(why));
}

// Device errors and ages. A head that stands where nobody knows is of no use to the far view.
void Skip::Impl::supervise(const SkipObservation& o) {
  if (o.head.error) lose_head(*o.head.error);
  if (state == SkipState::boot) return;
  if (o.now - o.head.joints.stamp > config.ages.head) lose_head("its angles are too old");
  if (state != SkipState::follow) return;
  if (o.now - pose_seen > config.ages.pose) lose_sight("the near view has not seen the sheet for too long");
  const bool far_needed = target(o.now).y_m > config.hand_over_y_m;
  if (far_needed && o.far_error) lose_head(*o.far_error);
  if (far_needed && o.now - far_seen > config.ages.far) lose_head("no picture of the far camera for too long");
}

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
  const bool stands = o.head.on_target && std::abs(o.head.joints.pan_radps) < turning_radps &&
                      std::abs(o.head.joints.tilt_radps) < turning_radps;
  if (!stands) {
    head_stands_since.reset();
    return command;
  }
  if (!head_stands_since) head_stands_since = o.now;
  if (!o.near || o.near->sheet.stamp < *head_stands_since + config.settle) return command;
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

SkipCommand Skip::Impl::wait(const SkipObservation& o, Duration) {
  if (head_lost) return stop(remarks.front(), o.now);
  if (o.now - since > config.deadlines.wait) return stop("no stone was seen to be thrown", o.now);
  if (watch->at(o.now).thrown()) {
    pose_seen = far_seen = o.now;
    enter(SkipState::follow, o.now);
  }
  return {.near_wanted = true, .far_wanted = true};
}

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

bool Skip::Impl::stands_elsewhere(const PlanarPose& seen) const {
  const PlanarPose& body = *diagnosis.body;
  return std::hypot(seen.x_m - body.x_m, seen.y_m - body.y_m) > config.moved_m ||
         std::abs(seen.yaw_rad - body.yaw_rad) > config.moved_rad;
}

void Skip::Impl::take_in(const SkipObservation& o) {
  if (o.release) watch->released(*o.release);
  if (sight_lost) return;
  if (o.near) take_near(*o.near);
  if (o.far && !head_lost) take_far(*o.far);
}

void Skip::Impl::take_near(const NearSight& near) {
  if (!near.sheet.ok) return;
  if (stands_elsewhere(near.sheet.body))
    return lose_sight("the robot was moved: the near view sees the sheet elsewhere");
  pose_seen = std::max(pose_seen, near.sheet.stamp);
  StonesPercept taken = near.stones;
  std::erase_if(taken.stones,
                [&](const StoneSighting& s) { return s.y_m > config.hand_over_y_m + config.hand_over_overlap_m; });
  watch->look(taken, View::near);
}

void Skip::Impl::take_far(const FarPercept& far) {
  far_seen = std::max(far_seen, far.stamp);
  if (!far.ok) return;
  StonesPercept taken;
  taken.ok = true;
  taken.stamp = far.stamp;
  for (const StoneSighting& s : far.stones) {
    if (s.y_m < config.hand_over_y_m - config.hand_over_overlap_m) continue;
    taken.stones.push_back(s);
    taken.stones.back().covariance = whole_covariance(far, s);
  }
  watch->look(taken, View::far);
  steer(far);
}

// The head learns from where the far picture showed the stone.
void Skip::Impl::steer(const FarPercept& far) {
  const World world = watch->at(far.stamp);
  const WorldStone* thrown = world.thrown();
  if (!thrown || thrown->phase == StonePhase::gone) return;
  const SlidingStone& at = thrown->motion.stone;
  const StoneSighting* nearest = nullptr;
  double least = gate_of(*thrown);
  for (const StoneSighting& s : far.stones) {
    const double gap = std::hypot(s.x_m - at.x_m, s.y_m - at.y_m);
    const bool anothers = std::any_of(world.stones.begin(), world.stones.end(), [&](const WorldStone& other) {
      const SlidingStone& o = other.motion.stone;
      return !other.thrown && std::hypot(s.x_m - o.x_m, s.y_m - o.y_m) < gap;
    });
    if (!anothers && gap < least) least = gap, nearest = &s;
  }
  if (!nearest) return;
  const Eigen::Vector3d cP = in_camera(far.eMc, {nearest->x_m, nearest->y_m, config.aiming.aim_height_m});
  if (!(cP.z() > 0.1)) return;
  aiming.look({far.stamp, cP.x() / cP.z(), cP.y() / cP.z()}, {far.stamp, at.x_m, at.y_m, at.vx_mps, at.vy_mps},
              *diagnosis.body);
}

GazeTarget Skip::Impl::target(Stamp stamp) const {
  if (last_target) return {stamp, last_target->x_m, last_target->y_m, last_target->vx_mps, last_target->vy_mps};
  return {stamp, config.wait_at.x_m, config.wait_at.y_m, 0.0, 0.0};
}

/// The sheet's pose now and then, and all pictures once something runs in the near view.
bool Skip::Impl::near_wanted(Stamp now) const {
  const double near_y_m = config.hand_over_y_m + 1.5 * config.hand_over_overlap_m;
  return (diagnosis.thrown && diagnosis.thrown->y_m < near_y_m) || head_lost || now - pose_seen > pose_refresh;
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

void Skip::Impl::note_world(Stamp now) {
  const World world = watch->at(now);
  diagnosis.expected.clear();
  for (const WorldStone& s : world.stones) {
    if (s.phase != StonePhase::gone) diagnosis.expected.push_back(expectation(s));
  }
  diagnosis.thrown.reset();
  diagnosis.stop.reset();
  const WorldStone* thrown = world.thrown();
  if (!thrown) return;
  const SlidingStone& at = thrown->motion.stone;
  diagnosis.thrown = at;
  diagnosis.thrown_covariance = expectation(*thrown).covariance;
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
