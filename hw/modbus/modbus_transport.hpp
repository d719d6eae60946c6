// Modbus exchanges over one line, TCP or RTU.
#pragma once

#include "hw/modbus/modbus_frames.hpp"
#include "hw/modbus/modbus_line.hpp"

namespace hogline::hw {

/// The exchange itself is made here: libmodbus 3.1.6 compares neither the unit nor the length of a TCP answer, and its
/// own error recovery does not return while a server is dead. Not thread-safe.
class ModbusTransport {
 public:
  ModbusTransport(std::unique_ptr<ModbusLine> line, modbus::Framing framing);

  std::optional<ModbusFault> open();
  void close();
  bool is_open() const { return open_; }

  /// Function 4. Throws away whatever a late answer has left on the line first.
  std::optional<ModbusFault> read_input(int unit, int address, std::span<std::uint16_t> values);
  /// Function 16, as read_input.
  std::optional<ModbusFault> write(int unit, int address, std::span<const std::uint16_t> values);

 private:
  std::variant<modbus::Answer, ModbusFault> exchange(const modbus::Request& request);
  std::variant<modbus::Answer, ModbusFault> receive(const modbus::Request& request);

  std::unique_ptr<ModbusLine> line_;
  modbus::Framing framing_;
  bool open_ = false;
  std::uint16_t transaction_ = 0;
};

}  // namespace hogline::hw
