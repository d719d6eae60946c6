// Adapter: jaws and spin belt behind one Modbus session.
#pragma once

#include "hw/gripper.hpp"
#include "hw/modbus/axis_client.hpp"
#include "hw/modbus/robotiq_jaws.hpp"

namespace hogline::hw {

struct ModbusGripperConfig {
  JawsConfig jaws;
  AxisConfig belt;
  double max_spin_radps = 0.0;  ///< a larger or non-finite order is refused
};

/// step() makes the exchanges itself, in the caller's thread; see ModbusSession for how long that can take. The
/// session must outlive the adapter and be used by no other thread.
class ModbusGripper final : public Gripper {
 public:
  ModbusGripper(ModbusSession& session, const ModbusGripperConfig& config);

  void step(Stamp now) override;
  /// The stamp is the older of jaws and belt; the error is the jaws' own, else the belt's.
  GripperState state() const override;
  void grip() override { jaws_.grip(); }
  void release() override { jaws_.release(); }
  void spin(double radps) override;
  void rearm() override;
  /// An order for the jaws, or the belt, that came too late to be carried out: latches.
  void drop_jaws_order(const std::string& why, Stamp now) { jaws_.refuse(DeviceErrorKind::timeout, why, now); }
  void drop_spin_order(const std::string& why, Stamp now) { belt_.refuse(DeviceErrorKind::timeout, why, now); }

 private:
  ModbusSession& session_;
  double max_spin_radps_;
  RobotiqJaws jaws_;
  AxisClient belt_;
  std::optional<double> spin_radps_;  ///< ordered and not yet handed to the belt
};

}  // namespace hogline::hw
