#include "hw/modbus/axis_client.hpp"

#include <utility>

namespace hogline::hw {

AxisClient::AxisClient(std::string device, axis::Kind kind, const AxisConfig& config)
    : config_(config), kind_(kind), latch_(std::move(device), config.silence_limit) {}

void AxisClient::order(const axis::Order& order) {
  if (latch_.error() || ordered_ == order) return;
  ordered_ = order;
  order_waits_ = true;
}

void AxisClient::refuse(DeviceErrorKind kind, const std::string& what, Stamp now) { latch_.latch(kind, what, now); }

void AxisClient::rearm() {
  latch_.rearm();
  ordered_.reset();
  order_waits_ = false;
  order_running_ = false;
  reset_waits_ = true;
  sent_at_.reset();
  sequence_.reset();
}

void AxisClient::step(ModbusSession& session, Stamp now) {
  if (latch_.error()) order_waits_ = false;
  if (order_waits_ && sequence_) send_order(session, now);

  if (next_poll_ && now < *next_poll_) return;
  next_poll_ = now + config_.poll_period;
  poll(session, now);
}

std::optional<ModbusFault> AxisClient::refresh(ModbusSession& session, Stamp now) {
  ++watchdog_;
  return session.write(config_.unit, axis::watchdog_address, {&watchdog_, 1}, now);
}

void AxisClient::send_order(ModbusSession& session, Stamp now) {
  order_waits_ = false;
  order_running_ = false;
  const auto fault = send(session, *ordered_, now);
  if (fault) return latch_.latch(fault->kind, "an order was not taken: " + fault->what, now);
}

// The device takes an order only on a fresh watchdog.
std::optional<ModbusFault> AxisClient::send(ModbusSession& session, const axis::Order& order, Stamp now) {
  if (auto fault = refresh(session, now)) return fault;
  sequence_ = axis::next_sequence(*sequence_);
  if (auto fault = session.write(config_.unit, axis::command_address, axis::encode(*sequence_, order), now)) {
    return fault;
  }
  sent_at_ = now;
  return std::nullopt;
}

// With the cause still there the device refuses, and says which it is.
void AxisClient::reset_fault(ModbusSession& session, const axis::Status& status, Stamp now) {
  if (status.fault == 0 && !send(session, {.command = axis::reset_fault}, now)) return;
  latch_.latch(DeviceErrorKind::device_fault, axis::describe_fault(status.fault) + "; the fault can not be reset", now);
}

void AxisClient::poll(ModbusSession& session, Stamp now) {
  if (!latch_.error()) {
    if (const auto fault = refresh(session, now)) return latch_.poll_failed(*fault, now);
  }
  std::array<std::uint16_t, 8> registers{};
  if (const auto fault = session.read_input(config_.unit, axis::status_address, registers, now)) {
    return latch_.poll_failed(*fault, now);
  }
  const auto status = axis::decode(registers);
  if (const auto wrong = contradiction(status)) {
    return latch_.poll_failed({DeviceErrorKind::protocol, *wrong}, now);
  }
  latch_.poll_succeeded(now);
  if (!sequence_) sequence_ = status.sequence_echo;
  const bool rearmed = std::exchange(reset_waits_, false) && !latch_.error();
  if (rearmed && status.faulted) return reset_fault(session, status, now);
  if (!belongs_to_order(status, now)) return;
  check_device(status, now);
  status_ = status;
  stamp_ = now;
}

std::optional<std::string> AxisClient::contradiction(const axis::Status& status) const {
  if (status.kind != static_cast<std::uint16_t>(kind_)) return "another kind of device, or another map, answers";
  if (status.watchdog_echo != watchdog_) return "the watchdog echo does not answer the refresh";
  return std::nullopt;
}

bool AxisClient::belongs_to_order(const axis::Status& status, Stamp now) {
  if (status.sequence_echo == *sequence_) {
    order_running_ = order_running_ || sent_at_.has_value();
    sent_at_.reset();
    return true;
  }
  if (!sent_at_) {
    latch_.latch(DeviceErrorKind::protocol, "the sequence echo changed without an order: restarted, or another master?",
                 now);
  } else if (now - *sent_at_ > config_.echo_deadline) {
    latch_.latch(DeviceErrorKind::protocol, "the sequence echo does not answer the order", now);
  }
  return false;
}

void AxisClient::check_device(const axis::Status& status, Stamp now) {
  if (status.faulted || status.fault != 0) {
    latch_.latch(DeviceErrorKind::device_fault, axis::describe_fault(status.fault), now);
  }
  if (status.watchdog_tripped && order_running_) {
    latch_.latch(DeviceErrorKind::device_fault, "its watchdog tripped: refreshes came too late", now);
  }
}

}  // namespace hogline::hw
