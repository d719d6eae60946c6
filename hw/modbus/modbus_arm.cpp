#include "hw/modbus/modbus_arm.hpp"

namespace hogline::hw {

namespace {

// Both end switches at once, or neither while standing, is not a position.
ArmPosition position_of(const axis::Status& status) {
  if (status.moving) return ArmPosition::moving;
  if (status.folded == status.unfolded) return ArmPosition::unknown;
  return status.folded ? ArmPosition::folded : ArmPosition::unfolded;
}

}  // namespace

ModbusArm::ModbusArm(ModbusSession& session, const AxisConfig& config)
    : session_(session), axis_("folding arm", axis::Kind::arm, config) {}

ArmState ModbusArm::state() const {
  const auto& status = axis_.status();
  return {
      .position = status ? position_of(*status) : ArmPosition::unknown, .stamp = axis_.stamp(), .error = axis_.error()};
}

}  // namespace hogline::hw
