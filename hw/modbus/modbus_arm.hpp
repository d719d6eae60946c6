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
  void rearm() override { axis_.rearm(); }
  /// An order that came too late to be carried out: latches.
  void drop_order(const std::string& why, Stamp now) { axis_.refuse(DeviceErrorKind::timeout, why, now); }

 private:
  ModbusSession& session_;
  AxisClient axis_;
};

}  // namespace hogline::hw
