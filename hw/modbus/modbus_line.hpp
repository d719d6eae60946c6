// The bytes of one Modbus line, whoever carries them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>

#include "hw/byte_line.hpp"
#include "hw/device_status.hpp"

namespace hogline::hw {

struct ModbusTcp {
  std::string address;  ///< dotted IPv4 address
  int port = 0;
};

struct ModbusRtu {
  std::string device;  ///< "/dev/serial/by-id/..."
  int baud = 0;        ///< one that the serial driver knows by name: 9600, 19200, .., 115200, ..
  char parity = 'N';   ///< 'N', 'E' or 'O'
  int data_bits = 8;
  int stop_bits = 1;
};

/// No defaults: every value comes from the rig file.
struct ModbusLineConfig {
  std::variant<ModbusTcp, ModbusRtu> line;
  Duration response_timeout{};  ///< the longest time that one exchange, or one attempt to connect, may take
};

/// Why an exchange failed.
struct ModbusFault {
  DeviceErrorKind kind = DeviceErrorKind::timeout;
  std::string what;
};

class ModbusLine {
 public:
  virtual ~ModbusLine() = default;
  /// Anew if it is open.
  virtual std::optional<ModbusFault> open() = 0;
  virtual void close() = 0;
  /// Begins an exchange: throws away whatever a late answer has left on the line.
  virtual void begin() = 0;
  virtual std::optional<ModbusFault> send(std::span<const std::uint8_t> bytes) = 0;
  /// At least one byte that has arrived, or a fault; `timeout` when nothing more comes in this exchange.
  virtual std::variant<std::size_t, ModbusFault> receive(std::span<std::uint8_t> buffer) = 0;
};

/// The machine's TCP or serial line. Throws std::invalid_argument when the line can not be described to libmodbus, or a
/// timeout is not positive.
std::unique_ptr<ModbusLine> open_kernel_line(const ModbusLineConfig& config);

/// A line whose other end has answered when a write returns: the stepped simulation. What can not be read then never
/// comes, so that no clock decides. The bytes must outlive the line.
std::unique_ptr<ModbusLine> stepped_line(ByteLine& bytes);

}  // namespace hogline::hw
