// The axis map, version 1 (doc/modbus.md), of spin belt and folding arm: encoded and decoded without any transport.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace hogline::hw::axis {

constexpr int command_address = 0x0100;   ///< three holding registers, written together
constexpr int watchdog_address = 0x0103;  ///< one holding register, written by itself
constexpr int status_address = 0x0200;    ///< eight input registers

enum class Kind : std::uint16_t { belt = 0x4231, arm = 0x4131 };

constexpr std::uint16_t reset_fault = 3;  ///< of either axis: clears a fault whose cause is gone; nothing moves

namespace belt {
constexpr std::uint16_t stop = 0;
constexpr std::uint16_t run = 1;
}  // namespace belt

namespace arm {
constexpr std::uint16_t stop = 0;
constexpr std::uint16_t fold = 1;
constexpr std::uint16_t unfold = 2;
}  // namespace arm

struct Order {
  std::uint16_t command = 0;
  std::int16_t argument = 0;
  bool operator==(const Order&) const = default;
};

struct Status {
  std::uint16_t kind = 0;
  std::uint16_t sequence_echo = 0;
  std::uint16_t watchdog_echo = 0;
  bool moving = false;
  bool at_target = false;
  bool watchdog_tripped = false;
  bool faulted = false;
  bool folded = false;
  bool unfolded = false;
  std::uint16_t fault = 0;
  std::int16_t actual = 0;
  std::uint16_t limit = 0;
  std::uint16_t watchdog_ms = 0;
};

std::array<std::uint16_t, 3> encode(std::uint16_t sequence, const Order& order);
Status decode(const std::array<std::uint16_t, 8>& registers);

/// The sequence that follows; 0 is never used.
std::uint16_t next_sequence(std::uint16_t sequence);

/// A rate of turn as an argument (0.001 rad/s); nothing when it is not finite or does not fit.
std::optional<std::int16_t> rate_argument(double radps);
double rate_radps(std::int16_t actual);

std::string describe_fault(std::uint16_t fault);

}  // namespace hogline::hw::axis
