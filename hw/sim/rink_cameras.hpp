// The robot's cameras on the simulated rink.
#pragma once

#include "hw/sim/rendered_camera.hpp"
#include "hw/sim/rink.hpp"
#include "vision/geometry/lens.hpp"
#include "vision/geometry/pose.hpp"

namespace hogline::hw::sim {

/// A camera as the rig file describes it. The true one is turned by the scenario's error of pitch.
struct CameraRig {
  vision::Intrinsics intrinsics;
  vision::Mount mount;
  double gamma = 0.0;
};

/// The near camera sees darkness unless the arm is unfolded. Each camera must not outlive the rink.
RenderedCamera near_camera(const Rink& rink, const Scenario& scenario, const CameraRig& rig, int threads);
RenderedCamera low_camera(const Rink& rink, const Scenario& scenario, const CameraRig& rig, int threads);

/// What the scenario's sheet and light look like.
RinkAppearance appearance_of(const Scenario& scenario);

/// Sensor, ice and timing that a scenario gives a camera of the rig.
SensorModel sensor_of(const Scenario& scenario, const CameraRig& rig, const CameraScenario& camera);
vision::Ice ice_of(const Scenario& scenario);
CameraTiming timing_of(const CameraScenario& camera, Stamp start);

/// How a stone looks whose team is the rig's first (red) or second (yellow).
StoneLook look_of(const StoneTruth& stone, double radius_m, int team);

}  // namespace hogline::hw::sim
