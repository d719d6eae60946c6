#include "hw/modbus/modbus_session.hpp"

#include <utility>

namespace hogline::hw {

namespace {

modbus::Framing framing_of(const ModbusLineConfig& config) {
  return std::holds_alternative<ModbusTcp>(config.line) ? modbus::Framing::tcp : modbus::Framing::rtu;
}

}  // namespace

ModbusSession::ModbusSession(const ModbusSessionConfig& config)
    : ModbusSession(config, open_kernel_line(config.line)) {}

ModbusSession::ModbusSession(const ModbusSessionConfig& config, std::unique_ptr<ModbusLine> line)
    : transport_(std::move(line), framing_of(config.line)), reconnect_delay_(config.reconnect_delay) {}

std::optional<ModbusFault> ModbusSession::ensure_open(Stamp now) {
  if (transport_.is_open()) return std::nullopt;
  if (retry_at_ && now < *retry_at_) return last_fault_;
  if (auto fault = transport_.open()) return judged(fault, now);
  ++connections_;
  retry_at_.reset();
  return std::nullopt;
}

std::optional<ModbusFault> ModbusSession::judged(std::optional<ModbusFault> fault, Stamp now) {
  const bool answered =
      !fault || fault->kind == DeviceErrorKind::refused || fault->kind == DeviceErrorKind::device_fault;
  if (!answered) {
    transport_.close();
    last_fault_ = *fault;
    retry_at_ = now + reconnect_delay_;
  }
  return fault;
}

std::optional<ModbusFault> ModbusSession::read_input(int unit, int address, std::span<std::uint16_t> values,
                                                     Stamp now) {
  if (auto fault = ensure_open(now)) return fault;
  ++exchanges_;
  return judged(transport_.read_input(unit, address, values), now);
}

std::optional<ModbusFault> ModbusSession::write(int unit, int address, std::span<const std::uint16_t> values,
                                                Stamp now) {
  if (auto fault = ensure_open(now)) return fault;
  ++exchanges_;
  return judged(transport_.write(unit, address, values), now);
}

}  // namespace hogline::hw
