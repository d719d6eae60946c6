// One Modbus line, TCP or RTU: the only file pair that knows libmodbus and file descriptors.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>

#include "hw/device_status.hpp"
#include "hw/modbus/modbus_frames.hpp"

extern "C" {
typedef struct _modbus modbus_t;
}

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

/// libmodbus opens, sets up, flushes and closes the line. The exchange itself is made here: libmodbus 3.1.6 compares
/// neither the unit nor the length of a TCP answer, and its own error recovery does not return while a server is dead.
/// Not thread-safe.
class ModbusTransport {
 public:
  /// Throws std::invalid_argument when the line can not be described to libmodbus, or a timeout is not positive.
  explicit ModbusTransport(const ModbusLineConfig& config);

  std::optional<ModbusFault> open();
  void close();
  bool is_open() const { return open_; }

  /// Function 4. Throws away whatever a late answer has left on the line first.
  std::optional<ModbusFault> read_input(int unit, int address, std::span<std::uint16_t> values);
  /// Function 16, as read_input.
  std::optional<ModbusFault> write(int unit, int address, std::span<const std::uint16_t> values);

 private:
  struct Free {
    void operator()(modbus_t* context) const;
  };
  using Deadline = std::chrono::steady_clock::time_point;

  std::variant<modbus::Answer, ModbusFault> exchange(const modbus::Request& request);
  std::optional<ModbusFault> send(std::span<const std::uint8_t> bytes, Deadline deadline);
  std::variant<modbus::Answer, ModbusFault> receive(const modbus::Request& request, Deadline deadline);

  modbus::Framing framing_;
  std::chrono::microseconds timeout_;
  std::unique_ptr<modbus_t, Free> context_;
  bool open_ = false;
  std::uint16_t transaction_ = 0;
};

}  // namespace hogline::hw
