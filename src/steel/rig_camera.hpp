// A camera as the rig file names its source.
#pragma once

#include <memory>
#include <string>

#include "hw/camera.hpp"
#include "hw/checks/checked_camera.hpp"
#include "hw/clock.hpp"
#include "src/config/rig.hpp"

namespace hogline {

/// A recording that can not be played is a camera that is in error. Null where the pictures are simulated. The clock
/// must outlive the camera. Throws ConfigError where the rig has no camera of this name.
std::unique_ptr<hw::Camera> open_rig_camera(const config::Rig& rig, const std::string& name, const hw::Clock& clock);

/// The same where pictures must come from somewhere: throws ConfigError where they are simulated.
std::unique_ptr<hw::Camera> open_real_camera(const config::Rig& rig, const std::string& name, const hw::Clock& clock);

/// What a user of that camera watches it by.
hw::CameraWatch watch_of(const config::Rig& rig, const std::string& name);

/// "aravis CURL1", "folder pictures", "video run.mp4", "simulated".
std::string describe_source(const config::CameraSource& source);

}  // namespace hogline
