// One Modbus line, TCP or RTU: the only file pair that knows libmodbus.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>

#include "hw/device_status.hpp"

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
  int baud = 0;
  char parity = 'N';  ///< 'N', 'E' or 'O'
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

/// Not thread-safe. libmodbus's own error recovery stays off: with a dead server it does not return.
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
  std::optional<ModbusFault> prepare(int unit);

  std::unique_ptr<modbus_t, Free> context_;
  bool open_ = false;
};

}  // namespace hogline::hw
