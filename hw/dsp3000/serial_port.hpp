// Adapter: a serial port of the machine (termios), eight data bits, no parity, one stop bit, no flow control.
#pragma once

#include <string>

#include "hw/byte_line.hpp"

namespace hogline::hw {

struct SerialPortConfig {
  std::string device;  ///< "/dev/serial/by-id/...": a name that stays when the adapter is plugged in anew
  int baud = 0;        ///< 9600, 19200, 38400, 57600, 115200 or 230400
};

class SerialPort final : public ByteLine {
 public:
  /// Throws std::invalid_argument for another baud rate.
  explicit SerialPort(const SerialPortConfig& config);
  ~SerialPort() override { close(); }
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  /// Throws away what waits on the line.
  std::optional<std::string> open() override;
  void close() override;
  std::optional<std::string> read() override;
  bool write(std::string_view bytes) override;

 private:
  std::string device_;
  unsigned speed_ = 0;
  int descriptor_ = -1;
};

}  // namespace hogline::hw
