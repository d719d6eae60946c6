// Gripper and arm behind one Modbus line, talked to by a thread of their own: the control thread never waits for it.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "hw/clock.hpp"
#include "hw/modbus/modbus_arm.hpp"
#include "hw/modbus/modbus_gripper.hpp"

namespace hogline::hw {

struct ModbusWorkerConfig {
  ModbusSessionConfig session;
  ModbusGripperConfig gripper;
  AxisConfig arm;
  Duration tick{};  ///< the thread steps the adapters this often, and at once when there is an order
};

/// The ports it gives take orders into a mailbox with one place for each kind of order (the newest of a kind counts, so
/// nothing piles up) and give copies of the newest states. Their step() does nothing. An order leaves at once, not with
/// the next tick. Stamps are the clock's time when the exchange began, so ages are never underestimated.
class ModbusWorker {
 public:
  /// The clock must outlive the worker and may be read from any thread.
  ModbusWorker(const ModbusWorkerConfig& config, const Clock& clock);
  ~ModbusWorker();
  ModbusWorker(const ModbusWorker&) = delete;
  ModbusWorker& operator=(const ModbusWorker&) = delete;

  Gripper& gripper() { return gripper_port_; }
  Arm& arm() { return arm_port_; }
  /// Clears latched errors of both; see ModbusGripper::rearm().
  void rearm();

 private:
  enum class JawsOrder { none, grip, release };
  enum class ArmOrder { none, fold, unfold };

  struct Mailbox {
    bool rearm = false;
    JawsOrder jaws = JawsOrder::none;
    ArmOrder arm = ArmOrder::none;
    std::optional<double> spin_radps;
    bool empty() const { return !rearm && jaws == JawsOrder::none && arm == ArmOrder::none && !spin_radps; }
  };

  class GripperPort final : public Gripper {
   public:
    explicit GripperPort(ModbusWorker& worker) : worker_(worker) {}
    void step(Stamp) override {}
    GripperState state() const override;
    void grip() override;
    void release() override;
    void spin(double radps) override;

   private:
    ModbusWorker& worker_;
  };

  class ArmPort final : public Arm {
   public:
    explicit ArmPort(ModbusWorker& worker) : worker_(worker) {}
    void step(Stamp) override {}
    ArmState state() const override;
    void fold() override;
    void unfold() override;

   private:
    ModbusWorker& worker_;
  };

  template <typename Change>
  void post(Change&& change);
  void run();
  void apply(const Mailbox& orders);

  const Clock& clock_;
  Duration tick_;
  ModbusSession session_;  // used by the thread only, as are the two adapters
  ModbusGripper gripper_;
  ModbusArm arm_;
  GripperPort gripper_port_;
  ArmPort arm_port_;

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  Mailbox mailbox_;  // under the mutex, as is what follows
  GripperState gripper_state_;
  ArmState arm_state_;
  bool stopping_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace hogline::hw
