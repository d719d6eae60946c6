#include "src/skip/skip_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hw/sim/skip_people.hpp"
#include "vision/geometry/lens.hpp"
#include "vision/geometry/sheet_camera.hpp"

namespace hogline {
namespace {

constexpr double handle_sigma_rad = 0.05;
constexpr double seen_height_m = 0.1;
constexpr double edge_px = 10.0;

hw::sim::CameraRig camera_rig(const vision::CameraSetup& setup) {
  return {.intrinsics = setup.intrinsics, .mount = setup.mount, .gamma = setup.gamma};
}

}  // namespace

SkipOracle::SkipOracle(const hw::sim::SkipRink& rink, const hw::sim::Scenario& scenario, const config::SkipRig& rig,
                       const hw::sim::HeadAxes& axes, const SkipOracleQuality& quality, std::uint64_t throw_number)
    : rink_(rink),
      scenario_(scenario),
      axes_(axes),
      far_{*rig.rig.far_camera, quality.far, 0.0},
      near_{*rig.rig.near_camera, quality.near, 0.0},
      quality_(quality),
      random_(scenario.seed * 4 + 3 + 1000003 * throw_number) {
  far_.shared_tilt_rad = quality.far.shared_tilt_rad * normal();
  near_.shared_tilt_rad = quality.near.shared_tilt_rad * normal();
}

servo::NearSight SkipOracle::near_view(const hw::Frame& frame, const servo::HeadAngles&, const servo::SkipDiagnosis&) {
  const hw::sim::SkipMoment moment = rink_.history().at(frame.stamp);
  const vision::Pose eMc = hw::sim::true_near_pose(moment, scenario_, camera_rig(near_.setup), axes_);
  servo::NearSight sight;
  SheetPosePercept& sheet = sight.sheet;
  sheet.ok = sight.stones.ok = true;
  sheet.stamp = sight.stones.stamp = frame.stamp;
  sheet.body = {scenario_.skip->x_m + quality_.place_m * normal(), scenario_.skip->y_m + quality_.place_m * normal(),
                scenario_.skip->yaw_rad + quality_.yaw_rad * normal()};
  sheet.sigma = {quality_.place_m, quality_.place_m, quality_.yaw_rad};
  sheet.sheet_width_m = scenario_.sheet.width_m;
  sheet.eMc = vision::row_major(eMc);
  sight.stones.stones = look(near_, eMc, moment, true);
  return sight;
}

FarPercept SkipOracle::far_view(const hw::Frame& frame, const servo::HeadAngles&, const servo::SkipDiagnosis&) {
  const hw::sim::SkipMoment moment = rink_.history().at(frame.stamp);
  const vision::Pose eMc = hw::sim::true_far_pose(moment, scenario_, camera_rig(far_.setup), axes_);
  FarPercept percept;
  percept.ok = true;
  percept.stamp = frame.stamp;
  percept.eMc = vision::row_major(eMc);
  percept.stones = look(far_, eMc, moment, false);
  return percept;
}

std::vector<StoneSighting> SkipOracle::look(const View& view, const vision::Pose& eMc,
                                            const hw::sim::SkipMoment& moment, bool handles) {
  const vision::SheetCamera camera(vision::Lens(view.setup.intrinsics), eMc, view.setup.ice);
  const Eigen::Vector3d eye = eMc.translation();
  const std::vector<hw::sim::PersonLook> people = hw::sim::skip_people(scenario_, axes_, moment);
  const auto& k = view.setup.intrinsics;
  std::uniform_real_distribution<double> share;
  std::vector<StoneSighting> seen;
  for (const hw::sim::FieldStone& stone : moment.stones) {
    if (stone.taken_off) continue;
    const Eigen::Vector3d place(stone.motion.x_m, stone.motion.y_m, seen_height_m);
    const auto pixel = camera.project(place);
    const bool inside = pixel && pixel->x() > edge_px && pixel->x() < k.width_px - edge_px && pixel->y() > edge_px &&
                        pixel->y() < k.height_px - edge_px;
    const bool hidden = std::any_of(people.begin(), people.end(), [&](const hw::sim::PersonLook& p) {
      return hw::sim::hides(p, {eye.x(), eye.y(), eye.z()}, {place.x(), place.y(), place.z()});
    });
    if (!inside || hidden || share(random_) < view.quality.missing_share) continue;
    seen.push_back(sighting(stone, view, eye, handles));
  }
  if (share(random_) < view.quality.clutter) {
    hw::sim::FieldStone nothing;
    nothing.motion.x_m = 4.0 * share(random_) - 2.0;
    nothing.motion.y_m = handles ? 8.0 * share(random_) - 2.0 : 7.0 + 18.0 * share(random_);
    seen.push_back(sighting(nothing, view, eye, false));
    seen.back().team = Team::unknown;
  }
  return seen;
}

StoneSighting SkipOracle::sighting(const hw::sim::FieldStone& stone, const View& view, const Eigen::Vector3d& eye,
                                   bool handles) {
  const StoneSightQuality& q = view.quality;
  const Eigen::Vector2d place(stone.motion.x_m, stone.motion.y_m), ray = place - eye.head<2>();
  const double range = ray.norm(), by_tilt = range * range / eye.z();
  const Eigen::Vector2d along = ray / range, across(-along.y(), along.x());
  const double along_sigma = std::hypot(q.along_m, q.tilt_rad * by_tilt);
  const double across_sigma = std::hypot(q.across_least_m, q.across_rad * range);
  const Eigen::Vector2d at =
      place + (along_sigma * normal() + view.shared_tilt_rad * by_tilt) * along + across_sigma * normal() * across;
  const Eigen::Matrix2d c =
      along_sigma * along_sigma * along * along.transpose() + across_sigma * across_sigma * across * across.transpose();
  StoneSighting seen;
  seen.x_m = at.x(), seen.y_m = at.y();
  seen.covariance = {c(0, 0), c(0, 1), c(1, 1)};
  seen.team = stone.team == 0 ? Team::first : Team::second;
  seen.team_confidence = 0.9;
  if (handles) {
    seen.handle_rad = std::remainder(stone.motion.handle_rad + handle_sigma_rad * normal(), std::numbers::pi);
    seen.handle_sigma_rad = handle_sigma_rad;
  }
  return seen;
}

}  // namespace hogline
