// One axis of our own register map (doc/modbus.md): the spin belt or the folding arm.
#pragma once

#include "hw/modbus/axis_registers.hpp"
#include "hw/modbus/fault_latch.hpp"
#include "hw/modbus/modbus_session.hpp"

namespace hogline::hw {

struct AxisConfig {
  int unit = 0;
  Duration poll_period{};    ///< also how often the watchdog is refreshed
  Duration echo_deadline{};  ///< from an order to the first status that belongs to it
  Duration silence_limit{};  ///< the longest time without a good answer that is forgiven
};

/// Sends each order once, refreshes the watchdog, checks every status by kind, watchdog echo and sequence echo. While
/// an error is latched it takes no order and does not refresh, so the axis stops by itself; it still reads. A fault of
/// the device is reset once when it is re-armed, and at no other time.
class AxisClient {
 public:
  AxisClient(std::string device, axis::Kind kind, const AxisConfig& config);

  void step(ModbusSession& session, Stamp now);
  /// Taken by the next step(). Repeating the last order does nothing.
  void order(const axis::Order& order);
  /// An order that can not be expressed or must not be sent: latches, and the axis stops by its watchdog.
  void refuse(DeviceErrorKind kind, const std::string& what, Stamp now);
  void rearm();

  const std::optional<axis::Status>& status() const { return status_; }
  Stamp stamp() const { return stamp_; }
  const std::optional<DeviceError>& error() const { return latch_.error(); }

 private:
  void send_order(ModbusSession& session, Stamp now);
  std::optional<ModbusFault> send(ModbusSession& session, const axis::Order& order, Stamp now);
  void reset_fault(ModbusSession& session, const axis::Status& status, Stamp now);
  void poll(ModbusSession& session, Stamp now);
  std::optional<ModbusFault> refresh(ModbusSession& session, Stamp now);
  std::optional<std::string> contradiction(const axis::Status& status) const;
  bool belongs_to_order(const axis::Status& status, Stamp now);
  void check_device(const axis::Status& status, Stamp now);

  AxisConfig config_;
  axis::Kind kind_;
  FaultLatch latch_;
  std::optional<axis::Order> ordered_;  ///< the last one taken
  bool order_waits_ = false;
  bool order_running_ = false;  ///< the last one sent has been echoed
  bool reset_waits_ = false;    ///< re-armed, and not read since
  std::optional<axis::Status> status_;
  Stamp stamp_{};
  std::optional<Stamp> next_poll_;
  std::optional<Stamp> sent_at_;           ///< until the order's echo was seen
  std::optional<std::uint16_t> sequence_;  ///< of the last order; nothing until the device's own was read
  std::uint16_t watchdog_ = 0;
};

}  // namespace hogline::hw
