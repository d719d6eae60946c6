// The jaws of a Robotiq 2F gripper, driven over a Modbus session.
#pragma once

#include "hw/gripper.hpp"
#include "hw/modbus/fault_latch.hpp"
#include "hw/modbus/modbus_session.hpp"
#include "hw/modbus/robotiq_registers.hpp"

namespace hogline::hw {

struct JawsConfig {
  int unit = 0;
  Duration poll_period{};
  Duration echo_deadline{};  ///< from an order to the first status that belongs to it
  Duration activation_deadline{};
  Duration silence_limit{};  ///< the longest time without a good answer that is forgiven
  std::uint8_t close_speed = 0;
  std::uint8_t close_force = 0;
  int freeing_travel = 0;  ///< counts by which the jaws must open until the stone is free: measured on site
};

/// Activates the jaws only to grip, and never while a stone may be held: from the moment something was in the jaws
/// until they were seen open or empty, or until rearm(), which is the operator's word that they are empty. Orders are
/// idempotent: repeating the last one does nothing. An order given while an error is latched is dropped.
class RobotiqJaws {
 public:
  explicit RobotiqJaws(const JawsConfig& config);

  /// Sends the order that waits, if any, then reads the status if it is due: each poll period, and in every step from a
  /// release until the stone is free.
  void step(ModbusSession& session, Stamp now);
  void grip();
  void release();
  /// An order that must not be sent: latches, and the jaws stay as they are.
  void refuse(DeviceErrorKind kind, const std::string& what, Stamp now) { latch_.latch(kind, what, now); }
  void rearm();

  JawState jaws() const { return jaws_; }
  bool activated() const { return activated_; }
  Stamp stamp() const { return stamp_; }  ///< of the newest status that belongs to the last order
  std::optional<Stamp> opening_since() const { return opening_since_; }
  /// When the jaws' reported travel passed freeing_travel, interpolated between two answers.
  std::optional<Stamp> freed_at() const { return freed_at_; }
  const std::optional<DeviceError>& error() const { return latch_.error(); }

 private:
  enum class Goal { none, grip, release };

  bool send(ModbusSession& session, const robotiq::Command& command, Stamp now);
  void send_order(ModbusSession& session, Stamp now);
  void start_grip(ModbusSession& session, Stamp now);
  void poll(ModbusSession& session, Stamp now);
  bool belongs_to_order(const robotiq::Status& status, Stamp now);
  void check_faults(const robotiq::Status& status, Stamp now);
  void check_activation(const robotiq::Status& status, Stamp now);
  void take_object(const robotiq::Status& status, Stamp now);
  void take_travel(const robotiq::Status& status, Stamp now);

  JawsConfig config_;
  FaultLatch latch_;
  Goal goal_ = Goal::none;
  bool order_waits_ = false;
  bool known_ = false;  ///< a status has been read since the start or the last rearm()
  bool activated_ = false;
  bool may_hold_ = false;
  JawState jaws_ = JawState::unknown;
  Stamp stamp_{};
  std::optional<Stamp> next_poll_;
  std::optional<Stamp> ordered_at_;  ///< until the echo of the order was seen
  std::optional<Stamp> activating_since_;
  std::optional<std::uint8_t> expected_echo_;
  std::optional<Stamp> opening_since_;
  std::optional<Stamp> freed_at_;
  std::optional<int> held_position_;  ///< counts, when the release was ordered
  int last_travel_ = 0;
  Stamp last_travel_stamp_{};
};

}  // namespace hogline::hw
