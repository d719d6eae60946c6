// What `hogline stones --camera far` does with a picture: the plan from --at and the rig's mount, then the far view.
#pragma once

#include <string>

#include "src/config/rig.hpp"
#include "vision/far_view/far_view.hpp"

namespace hogline {

/// The body's pose in e from "X_M,Y_M,YAW_DEG". Throws ConfigError.
PlanarPose parse_at(const std::string& text);

/// What the far view is told by the rig file. Throws ConfigError where the rig has no far camera.
vision::FarSetup far_setup(const config::Rig& rig);

/// Where body and mount put the camera. How wrong that may be is not said on the command line: the defaults hold.
vision::FarPlan far_plan(const vision::CameraSetup& camera, const PlanarPose& body);

}  // namespace hogline
