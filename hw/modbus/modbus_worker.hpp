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
  Duration tick{};             ///< the thread steps the adapters this often, and at once when there is an order
  Duration order_age_limit{};  ///< an order that waited longer for the line is dropped, and that is an error
};

/// An order in the mailbox.
template <typename What>
struct PostedOrder {
  What what{};
  Stamp since{};
};

/// The ports it gives take orders into a mailbox with one place for each kind of order (the newest of a kind counts, so
/// nothing piles up) and give copies of the newest states. Their step() does nothing. An order leaves at once, not with
/// the next tick; while an exchange is under way it waits, and if that takes too long it is dropped: a stone let go
/// late is worse than one kept. Stamps are the clock's time when the exchange began, so ages are never underestimated.
class ModbusWorker {
 public:
  /// The clock must outlive the worker and may be read from any thread.
  ModbusWorker(const ModbusWorkerConfig& config, const Clock& clock);
  ~ModbusWorker();
  ModbusWorker(const ModbusWorker&) = delete;
  ModbusWorker& operator=(const ModbusWorker&) = delete;

  Gripper& gripper() { return gripper_port_; }
  Arm& arm() { return arm_port_; }

 private:
  enum class JawsOrder { grip, release };
  enum class ArmOrder { fold, unfold };

  struct Mailbox {
    bool rearm_gripper = false;
    bool rearm_arm = false;
    std::optional<PostedOrder<JawsOrder>> jaws;
    std::optional<PostedOrder<double>> spin_radps;
    std::optional<PostedOrder<ArmOrder>> arm;
    bool empty() const { return !rearm_gripper && !rearm_arm && !jaws && !spin_radps && !arm; }
  };

  class GripperPort final : public Gripper {
   public:
    explicit GripperPort(ModbusWorker& worker) : worker_(worker) {}
    void step(Stamp) override {}
    GripperState state() const override;
    void grip() override;
    void release() override;
    void spin(double radps) override;
    void rearm() override;

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
    void rearm() override;

   private:
    ModbusWorker& worker_;
  };

  template <typename Change>
  void post(Change&& change);
  void run();
  void apply(const Mailbox& orders);
  void apply_jaws(const PostedOrder<JawsOrder>& order, Stamp now);
  void apply_spin(const PostedOrder<double>& order, Stamp now);
  void apply_arm(const PostedOrder<ArmOrder>& order, Stamp now);
  bool too_old(Stamp since, Stamp now) const { return now - since > order_age_limit_; }

  const Clock& clock_;
  Duration tick_;
  Duration order_age_limit_;
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
