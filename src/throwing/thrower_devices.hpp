// The ports a thrower needs, whoever stands behind them.
#pragma once

#include "hw/arm.hpp"
#include "hw/camera.hpp"
#include "hw/drive.hpp"
#include "hw/gripper.hpp"
#include "hw/gyro.hpp"

namespace hogline {

/// References: the owner of the devices outlives the loop.
struct ThrowerDevices {
  hw::Drive& drive;
  hw::Gripper& gripper;
  hw::Arm& arm;
  hw::Gyro& gyro;
  hw::Camera& near_camera;
  hw::Camera& low_camera;
};

}  // namespace hogline
