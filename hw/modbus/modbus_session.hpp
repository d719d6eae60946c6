// One connection, shared by every device behind it, that opens itself again.
#pragma once

#include <cstdint>

#include "hw/modbus/modbus_transport.hpp"

namespace hogline::hw {

struct ModbusSessionConfig {
  ModbusLineConfig line;
  Duration reconnect_delay{};  ///< between a failure and the next attempt to connect
};

/// Owns the line. An exchange opens the line if it is closed and the delay since the last failure has passed; otherwise
/// it fails at once, with that
/// failure's cause. Any failure but an exception answer closes the line: a late answer can then never be taken for
/// another one. So one step of a control loop waits at most one response timeout, or one to connect and one to talk.
/// Used from one thread.
class ModbusSession {
 public:
  /// On the machine's line.
  explicit ModbusSession(const ModbusSessionConfig& config);
  /// On another line, in the framing that the configuration asks for.
  ModbusSession(const ModbusSessionConfig& config, std::unique_ptr<ModbusLine> line);

  std::optional<ModbusFault> read_input(int unit, int address, std::span<std::uint16_t> values, Stamp now);
  std::optional<ModbusFault> write(int unit, int address, std::span<const std::uint16_t> values, Stamp now);

  bool connected() const { return transport_.is_open(); }
  std::uint64_t connections() const { return connections_; }  ///< how often the line was opened
  std::uint64_t exchanges() const { return exchanges_; }      ///< requests sent

 private:
  std::optional<ModbusFault> ensure_open(Stamp now);
  std::optional<ModbusFault> judged(std::optional<ModbusFault> fault, Stamp now);

  ModbusTransport transport_;
  Duration reconnect_delay_;
  std::optional<Stamp> retry_at_;
  ModbusFault last_fault_;  ///< why the line is closed
  std::uint64_t connections_ = 0;
  std::uint64_t exchanges_ = 0;
};

}  // namespace hogline::hw
