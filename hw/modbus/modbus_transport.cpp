#include "hw/modbus/modbus_transport.hpp"

#include <modbus/modbus.h>

#include <cerrno>
#include <stdexcept>

namespace hogline::hw {

namespace {

modbus_t* new_context(const ModbusTcp& line) { return modbus_new_tcp(line.address.c_str(), line.port); }
modbus_t* new_context(const ModbusRtu& line) {
  return modbus_new_rtu(line.device.c_str(), line.baud, line.parity, line.data_bits, line.stop_bits);
}

DeviceErrorKind kind_of(int error) {
  if (error == ETIMEDOUT || error == EAGAIN) return DeviceErrorKind::timeout;
  if (error == EMBXSFAIL) return DeviceErrorKind::device_fault;
  if (error >= EMBXILFUN && error <= EMBXGTAR) return DeviceErrorKind::refused;
  if (error > MODBUS_ENOBASE) return DeviceErrorKind::protocol;
  return DeviceErrorKind::disconnected;
}

ModbusFault fault_of(int error, const char* doing) {
  return {kind_of(error), std::string(doing) + ": " + modbus_strerror(error)};
}

}  // namespace

void ModbusTransport::Free::operator()(modbus_t* context) const {
  modbus_close(context);
  modbus_free(context);
}

ModbusTransport::ModbusTransport(const ModbusLineConfig& config)
    : context_(std::visit([](const auto& line) { return new_context(line); }, config.line)) {
  if (!context_) throw std::invalid_argument("Modbus line: the address or serial settings are not usable");
  const auto timeout_us = std::chrono::duration_cast<std::chrono::microseconds>(config.response_timeout).count();
  if (timeout_us <= 0) throw std::invalid_argument("Modbus line: the response timeout must be positive");
  modbus_set_error_recovery(context_.get(), MODBUS_ERROR_RECOVERY_NONE);
  modbus_set_response_timeout(context_.get(), static_cast<std::uint32_t>(timeout_us / 1000000),
                              static_cast<std::uint32_t>(timeout_us % 1000000));
  // Zero: the response timeout bounds the whole answer, not only its first byte.
  modbus_set_byte_timeout(context_.get(), 0, 0);
}

std::optional<ModbusFault> ModbusTransport::open() {
  close();
  if (modbus_connect(context_.get()) != 0) {
    const auto fault = fault_of(errno, "connecting");
    modbus_close(context_.get());
    return ModbusFault{DeviceErrorKind::disconnected, fault.what};
  }
  open_ = true;
  return std::nullopt;
}

void ModbusTransport::close() {
  if (open_) modbus_close(context_.get());
  open_ = false;
}

std::optional<ModbusFault> ModbusTransport::prepare(int unit) {
  if (!open_) return ModbusFault{DeviceErrorKind::disconnected, "no connection"};
  if (modbus_set_slave(context_.get(), unit) != 0) return fault_of(errno, "choosing the unit");
  modbus_flush(context_.get());
  return std::nullopt;
}

std::optional<ModbusFault> ModbusTransport::read_input(int unit, int address, std::span<std::uint16_t> values) {
  if (auto fault = prepare(unit)) return fault;
  const int count = static_cast<int>(values.size());
  const int got = modbus_read_input_registers(context_.get(), address, count, values.data());
  if (got < 0) return fault_of(errno, "reading");
  if (got != count) return ModbusFault{DeviceErrorKind::protocol, "reading: wrong number of registers"};
  return std::nullopt;
}

std::optional<ModbusFault> ModbusTransport::write(int unit, int address, std::span<const std::uint16_t> values) {
  if (auto fault = prepare(unit)) return fault;
  const int count = static_cast<int>(values.size());
  const int done = modbus_write_registers(context_.get(), address, count, values.data());
  if (done < 0) return fault_of(errno, "writing");
  if (done != count) return ModbusFault{DeviceErrorKind::protocol, "writing: wrong number of registers"};
  return std::nullopt;
}

}  // namespace hogline::hw
