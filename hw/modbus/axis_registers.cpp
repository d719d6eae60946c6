#include "hw/modbus/axis_registers.hpp"

#include <cmath>

namespace hogline::hw::axis {

std::array<std::uint16_t, 3> encode(std::uint16_t sequence, const Order& order) {
  return {sequence, order.command, static_cast<std::uint16_t>(order.argument)};
}

Status decode(const std::array<std::uint16_t, 8>& registers) {
  const unsigned bits = registers[3];
  return {.kind = registers[0],
          .sequence_echo = registers[1],
          .watchdog_echo = registers[2],
          .moving = (bits & 0x01U) != 0,
          .at_target = (bits & 0x02U) != 0,
          .watchdog_tripped = (bits & 0x04U) != 0,
          .faulted = (bits & 0x08U) != 0,
          .folded = (bits & 0x10U) != 0,
          .unfolded = (bits & 0x20U) != 0,
          .fault = registers[4],
          .actual = static_cast<std::int16_t>(registers[5]),
          .limit = registers[6],
          .watchdog_ms = registers[7]};
}

std::uint16_t next_sequence(std::uint16_t sequence) {
  return sequence == 0xFFFF ? std::uint16_t{1} : static_cast<std::uint16_t>(sequence + 1);
}

std::optional<std::int16_t> rate_argument(double radps) {
  const double argument = std::round(radps * 1e3);
  if (!std::isfinite(argument) || argument < -32768.0 || argument > 32767.0) return std::nullopt;
  return static_cast<std::int16_t>(argument);
}

double rate_radps(std::int16_t actual) { return 1e-3 * actual; }

std::string describe_fault(std::uint16_t fault) {
  switch (fault) {
    case 0:
      return "a fault whose cause is gone: it waits for its reset";
    case 1:
      return "overcurrent";
    case 2:
      return "blocked";
    case 3:
      return "too hot";
    case 4:
      return "sensor";
    default:
      return "unknown fault code " + std::to_string(fault);
  }
}

}  // namespace hogline::hw::axis
