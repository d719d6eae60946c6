// The ports a thrower needs, whoever stands behind them.
#pragma once

#include "hw/arm.hpp"
#include "hw/camera.hpp"
#include "hw/clock.hpp"
#include "hw/drive.hpp"
#include "hw/gripper.hpp"
#include "hw/gyro.hpp"
#include "hw/operator_switch.hpp"

namespace hogline {

/// References: the owner of the devices outlives the loop.
struct ThrowerDevices {
  hw::Drive& drive;
  hw::Gripper& gripper;
  hw::Arm& arm;
  hw::Gyro& gyro;
  hw::Camera& near_camera;
  hw::Camera& low_camera;
  hw::OperatorSwitch& operator_switch;
  const hw::Clock& clock;
};

}  // namespace hogline
