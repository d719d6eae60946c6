// Gripper and arm as the tests run them: polled every fourth control period.
#pragma once

#include "hw/modbus/modbus_arm.hpp"
#include "hw/modbus/modbus_gripper.hpp"

namespace hogline::hw {

/// How often a device is asked, and how long it may keep still.
struct AdapterPace {
  Duration poll_period = std::chrono::milliseconds(20);
  Duration echo_deadline = std::chrono::milliseconds(60);
  Duration activation_deadline = std::chrono::seconds(3);
  Duration silence_limit = std::chrono::milliseconds(60);
};

inline JawsConfig jaws_config(const AdapterPace& pace = {}) {
  return {.unit = 9,
          .poll_period = pace.poll_period,
          .echo_deadline = pace.echo_deadline,
          .activation_deadline = pace.activation_deadline,
          .silence_limit = pace.silence_limit,
          .close_speed = 255,
          .close_force = 128,
          .freeing_travel = 20};
}

inline AxisConfig axis_config(int unit, const AdapterPace& pace = {}) {
  return {.unit = unit,
          .poll_period = pace.poll_period,
          .echo_deadline = pace.echo_deadline,
          .silence_limit = pace.silence_limit};
}

inline ModbusGripperConfig gripper_config(double max_spin_radps = 2.5, const AdapterPace& pace = {}) {
  return {.jaws = jaws_config(pace), .belt = axis_config(10, pace), .max_spin_radps = max_spin_radps};
}

inline AxisConfig arm_config(const AdapterPace& pace = {}) { return axis_config(11, pace); }

}  // namespace hogline::hw
