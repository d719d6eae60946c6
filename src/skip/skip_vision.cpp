#include "src/skip/skip_vision.hpp"

#include <algorithm>
#include <cmath>

#include "src/stones_setup.hpp"
#include "vision/far_view/far_view.hpp"
#include "vision/fit_percept.hpp"
#include "vision/near_view.hpp"
#include "vision/planned_sheet.hpp"
#include "vision/stone_sequence.hpp"

namespace hogline {
namespace {

constexpr double most_residual_px = 0.5;  // as the near view asks of its acquisitions
constexpr double most_turn_rad = 0.012;   // of the fitted camera against body and joints
constexpr double most_shift_m = 0.06;
constexpr double same_angle_rad = 5e-4;

vision::Pose pose_of(const servo::HeadGeometry& head, const servo::HeadAngles& q, const PlanarPose& body) {
  const servo::HeadPose at = servo::camera_pose(head, q);
  vision::Pose bMc = vision::Pose::Identity();
  bMc.linear() = at.bRc;
  bMc.translation() = at.bPc;
  return vision::eMb(body) * bMc;
}

/// The same mount as angles: the camera on a head that has turned.
vision::Mount mount_of(const servo::HeadGeometry& head, const servo::HeadAngles& q) {
  const servo::HeadPose at = servo::camera_pose(head, q);
  // bMc(mount) = T Rz(yaw) Ry(pitch) Rx(roll) with the camera's axes: x right is -y, y down is -z, z forward is x.
  Eigen::Matrix3d aligned;
  aligned.col(0) = at.bRc.col(2);
  aligned.col(1) = -at.bRc.col(0);
  aligned.col(2) = -at.bRc.col(1);
  vision::Mount mount{.x_m = at.bPc.x(), .y_m = at.bPc.y(), .z_m = at.bPc.z()};
  mount.pitch_rad = std::asin(std::clamp(-aligned(2, 0), -1.0, 1.0));
  mount.yaw_rad = std::atan2(aligned(1, 0), aligned(0, 0));
  mount.roll_rad = std::atan2(aligned(2, 1), aligned(2, 2));
  return mount;
}

std::vector<StoneExpectation> expected_of(const servo::SkipDiagnosis& known, Stamp moment) {
  std::vector<StoneExpectation> expected;
  for (const servo::ExpectedStone& s : known.expected) expected.push_back(s.at(moment));
  return expected;
}

vision::FarSetup far_setup(const config::SkipRig& rig) {
  const vision::StonesSetup stones = stones_setup(rig.rig);
  return {.camera = rig.rig.camera("far"), .shape = stones.shape, .teams = stones.teams};
}

}  // namespace

struct SkipVision::Impl {
  explicit Impl(const config::SkipRig& skip_rig)
      : rig(skip_rig),
        near(rig.rig.camera("near")),
        sheet(rig.rig.camera("near")),
        stones(stones_setup(rig.rig)),
        far(far_setup(rig)) {}

  SheetPosePercept fitted(const hw::Frame& frame, const servo::HeadAngles& q, const servo::SkipDiagnosis& known);
  SheetPosePercept acquired(const hw::Frame& frame, const servo::HeadAngles& q);

  config::SkipRig rig;
  std::optional<vision::NearView> near;  ///< for the mount as the head holds it
  std::optional<servo::HeadAngles> near_at;
  vision::PlannedSheet sheet;
  vision::StoneSequence stones;
  vision::FarSequence far;
};

SkipVision::SkipVision(const config::SkipRig& rig) : impl_(std::make_unique<Impl>(rig)) {}
SkipVision::~SkipVision() = default;

SheetPosePercept SkipVision::Impl::fitted(const hw::Frame& frame, const servo::HeadAngles& q,
                                          const servo::SkipDiagnosis& known) {
  SheetPosePercept percept;
  percept.stamp = frame.stamp;
  const vision::Pose planned = pose_of(rig.skip.near_head, q, *known.body);
  const vision::SheetFitResult& result = sheet.look(frame.bgr, frame.stamp, planned, known.sheet_width_m);
  percept.reason = result.reason;
  if (!result.ok) return percept;
  const vision::Pose moved = planned.inverse() * result.eMc;
  const bool elsewhere = Eigen::AngleAxisd(moved.linear()).angle() > most_turn_rad ||
                         moved.translation().norm() > most_shift_m || result.residual_px > most_residual_px;
  if (elsewhere) {
    percept.reason = "the paint does not lie where body and joints put it";
    return percept;
  }
  percept.features.emplace_back(sheet.tracked() ? "tracked" : "fitted");
  vision::fill_percept(result, percept);
  percept.body = vision::planar_body(result.eMc, mount_of(rig.skip.near_head, q));
  return percept;
}

SheetPosePercept SkipVision::Impl::acquired(const hw::Frame& frame, const servo::HeadAngles& q) {
  const bool same =
      near_at && std::hypot(q.pan_rad - near_at->pan_rad, q.tilt_rad - near_at->tilt_rad) < same_angle_rad;
  if (!same) {
    vision::CameraSetup setup = rig.rig.camera("near");
    setup.mount = mount_of(rig.skip.near_head, q);
    near.emplace(setup);
    near_at = q;
  }
  return near->acquire(frame.bgr, frame.stamp);
}

servo::NearSight SkipVision::near_view(const hw::Frame& frame, const servo::HeadAngles& q,
                                       const servo::SkipDiagnosis& known) {
  servo::NearSight sight;
  sight.sheet = known.body ? impl_->fitted(frame, q, known) : impl_->acquired(frame, q);
  sight.stones.stamp = frame.stamp;
  if (!sight.sheet.ok) {
    sight.stones.reason = "the sheet's pose: " + sight.sheet.reason;
    return sight;
  }
  const auto width = sight.sheet.sheet_width_m ? sight.sheet.sheet_width_m : known.sheet_width_m;
  // A stone that runs out is followed until it is out: the finder leaves out what lies beyond the sidelines.
  const auto wide = width ? std::optional(*width + 0.6) : std::nullopt;
  // Before the throw there is time to look at everything, again and again.
  if (!known.body) impl_->stones.forget();
  sight.stones = impl_->stones.look(frame.bgr, frame.stamp, vision::from_row_major(sight.sheet.eMc), wide,
                                    expected_of(known, frame.stamp));
  return sight;
}

FarPercept SkipVision::far_view(const hw::Frame& frame, const servo::HeadAngles& q, const servo::SkipDiagnosis& known) {
  if (!known.body) {
    FarPercept nothing;
    nothing.stamp = frame.stamp;
    nothing.reason = "the body's pose is not known";
    return nothing;
  }
  vision::FarPlan plan;
  plan.eMc = pose_of(impl_->rig.skip.aiming.head, q, *known.body);
  plan.pan_sigma_rad = std::hypot(impl_->rig.far_mount_sigma_rad, known.body_sigma.yaw_rad);
  plan.tilt_sigma_rad = plan.roll_sigma_rad = impl_->rig.far_mount_sigma_rad;
  plan.sheet_width_m = known.sheet_width_m;
  return impl_->far.look(frame.bgr, frame.stamp, plan, expected_of(known, frame.stamp));
}

}  // namespace hogline
