// Adapter: the folding arm behind a Modbus session.
#pragma once

#include "hw/arm.hpp"
#include "hw/modbus/axis_client.hpp"

namespace hogline::hw {

/// As ModbusGripper: exchanges in the caller's thread, the session outlives the adapter.
class ModbusArm final : public Arm {
 public:
  ModbusArm(ModbusSession& session, const AxisConfig& config);

  void step(Stamp now) override { axis_.step(session_, now); }
  ArmState state() const override;
  void fold() override { axis_.order({axis::arm::fold, 0}); }
  void unfold() override { axis_.order({axis::arm::unfold, 0}); }
  /// Clears a latched error; an order is needed anew.
  void rearm() { axis_.rearm(); }

 private:
  ModbusSession& session_;
  AxisClient axis_;
};

}  // namespace hogline::hw
