// The simulated rink that a rig file asks for: the devices that it expects to find.
#pragma once

#include "hw/sim/rink.hpp"
#include "hw/sim/rink_cameras.hpp"
#include "src/config/thrower_rig.hpp"

namespace hogline {

/// Wheel radius, track, the stone's place and the gyro's variant are the rig's.
hw::sim::Scenario completed(hw::sim::Scenario scenario, const config::ThrowerRig& rig);

/// Precondition: the scenario is completed.
hw::sim::RinkConfig rink_config(const config::ThrowerRig& rig, const hw::sim::Scenario& scenario);

hw::sim::CameraRig camera_rig(const vision::CameraSetup& setup);

}  // namespace hogline
