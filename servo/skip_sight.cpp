#include <algorithm>
#include <cmath>

#include "servo/skip_impl.hpp"

namespace hogline::servo {
namespace {

constexpr double steering_gate_m = 0.15;  // a far look this near to the estimate may steer the head, and
constexpr double steering_sigmas = 3.0;   // within these

Eigen::Vector3d in_camera(const std::array<double, 16>& m, const Eigen::Vector3d& eP) {
  Eigen::Matrix3d eRc;
  eRc << m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10];
  return eRc.transpose() * (eP - Eigen::Vector3d(m[3], m[7], m[11]));
}

double gate_of(const WorldStone& stone) {
  const MotionCovariance& c = stone.motion.covariance;
  return steering_gate_m + steering_sigmas * std::sqrt(c(0, 0) + c(1, 1));
}

}  // namespace

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

bool Skip::Impl::stands_elsewhere(const PlanarPose& seen) const {
  const PlanarPose& body = *diagnosis.body;
  return std::hypot(seen.x_m - body.x_m, seen.y_m - body.y_m) > config.moved_m ||
         std::abs(seen.yaw_rad - body.yaw_rad) > config.moved_rad;
}

}  // namespace hogline::servo
