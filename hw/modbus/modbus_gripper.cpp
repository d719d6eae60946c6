#include "hw/modbus/modbus_gripper.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::hw {

ModbusGripper::ModbusGripper(ModbusSession& session, const ModbusGripperConfig& config)
    : session_(session),
      max_spin_radps_(config.max_spin_radps),
      jaws_(config.jaws),
      belt_("spin belt", axis::Kind::belt, config.belt) {}

void ModbusGripper::spin(double radps) { spin_radps_ = radps; }

void ModbusGripper::step(Stamp now) {
  if (spin_radps_) {
    const auto argument = axis::rate_argument(*spin_radps_);
    if (argument && std::abs(*spin_radps_) <= max_spin_radps_) {
      belt_.order({*argument == 0 ? axis::belt::stop : axis::belt::run, *argument});
    } else {
      belt_.refuse(DeviceErrorKind::implausible, "a spin beyond the limit, or not a number, was ordered", now);
    }
    spin_radps_.reset();
  }
  jaws_.step(session_, now);
  belt_.step(session_, now);
}

GripperState ModbusGripper::state() const {
  const auto& belt = belt_.status();
  return {.jaws = jaws_.jaws(),
          .activated = jaws_.activated(),
          .spin_radps = belt ? axis::rate_radps(belt->actual) : 0.0,
          .stamp = std::min(jaws_.stamp(), belt_.stamp()),
          .opening_since = jaws_.opening_since(),
          .freed_at = jaws_.freed_at(),
          .error = jaws_.error() ? jaws_.error() : belt_.error()};
}

void ModbusGripper::rearm() {
  jaws_.rearm();
  belt_.rearm();
}

}  // namespace hogline::hw
