// The skip's cameras on the simulated rink: both turn with the head.
#pragma once

#include <array>

#include "hw/sim/rendered_camera.hpp"
#include "hw/sim/rink_cameras.hpp"
#include "hw/sim/skip_rink.hpp"

namespace hogline::hw::sim {

/// Where the head's axes are, as the rig file says: a point of the pan axis in b, and from there to the tilt axis.
struct HeadAxes {
  std::array<double, 3> pan_axis_m{};
  std::array<double, 3> tilt_axis_m{};
};

/// `rig.mount`: of the camera at pan = tilt = 0. Each camera must not outlive the rink.
RenderedCamera skip_near_camera(const SkipRink& rink, const Scenario& scenario, const CameraRig& rig,
                                const HeadAxes& axes, int threads);
RenderedCamera skip_far_camera(const SkipRink& rink, const Scenario& scenario, const CameraRig& rig,
                               const HeadAxes& axes, int threads);

/// Where a camera truly is, with the scenario's errors of its mount and of the head's zeros.
vision::Pose true_far_pose(const SkipMoment& moment, const Scenario& scenario, const CameraRig& rig,
                           const HeadAxes& axes);
vision::Pose true_near_pose(const SkipMoment& moment, const Scenario& scenario, const CameraRig& rig,
                            const HeadAxes& axes);

/// Everybody on the ice in that moment.
std::vector<PersonLook> skip_people(const Scenario& scenario, const HeadAxes& axes, const SkipMoment& moment);

}  // namespace hogline::hw::sim
