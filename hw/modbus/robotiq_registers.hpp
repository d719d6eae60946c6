// The Robotiq 2F register map, encoded and decoded without any transport. Source: the maker's instruction manual, as
// restated in doc/modbus.md.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace hogline::hw::robotiq {

constexpr int command_address = 0x03E8;  ///< holding registers, function 16
constexpr int status_address = 0x07D0;   ///< input registers, function 4
constexpr std::uint8_t open_position = 0;
constexpr std::uint8_t closed_position = 255;

using Registers = std::array<std::uint16_t, 3>;

struct Command {
  bool activate = false;
  bool go_to = false;
  bool automatic_release = false;
  std::uint8_t position = open_position;
  std::uint8_t speed = 0;
  std::uint8_t force = 0;
};

enum class Activation { reset = 0, activating = 1, reserved = 2, active = 3 };
enum class Object { moving = 0, contact_opening = 1, contact_closing = 2, at_position = 3 };

struct Status {
  bool activated = false;
  bool go_to = false;
  Activation activation = Activation::reset;
  Object object = Object::moving;
  std::uint8_t fault = 0;
  std::uint8_t position_echo = 0;  ///< of the position asked for: proves that the status belongs to the command
  std::uint8_t position = 0;
  double current_a = 0.0;
};

Registers encode(const Command& command);
Status decode(const Registers& registers);

/// The maker's words for a fault code; the number itself for an unknown one.
std::string describe_fault(std::uint8_t fault);

}  // namespace hogline::hw::robotiq
