#include "hw/modbus/robotiq_registers.hpp"

namespace hogline::hw::robotiq {

namespace {

constexpr std::uint16_t join(unsigned high, unsigned low) { return static_cast<std::uint16_t>(high << 8U | low); }
constexpr std::uint8_t high_byte(std::uint16_t word) { return static_cast<std::uint8_t>(word >> 8U); }
constexpr std::uint8_t low_byte(std::uint16_t word) { return static_cast<std::uint8_t>(word & 0xFFU); }

}  // namespace

Registers encode(const Command& command) {
  const unsigned action =
      (command.activate ? 0x01U : 0U) | (command.go_to ? 0x08U : 0U) | (command.automatic_release ? 0x10U : 0U);
  return {join(action, 0), join(0, command.position), join(command.speed, command.force)};
}

Status decode(const Registers& registers) {
  const unsigned bits = high_byte(registers[0]);
  return {.activated = (bits & 0x01U) != 0,
          .go_to = (bits & 0x08U) != 0,
          .activation = static_cast<Activation>(bits >> 4U & 0x03U),
          .object = static_cast<Object>(bits >> 6U & 0x03U),
          .fault = high_byte(registers[1]),
          .position_echo = low_byte(registers[1]),
          .position = high_byte(registers[2]),
          .current_a = 0.01 * low_byte(registers[2])};
}

std::string describe_fault(std::uint8_t fault) {
  switch (fault) {
    case 0x00:
      return "no fault";
    case 0x05:
      return "action delayed: activation must be completed first";
    case 0x07:
      return "the activation bit must be set before an action";
    case 0x08:
      return "too hot";
    case 0x09:
      return "no communication for one second";
    case 0x0A:
      return "supply voltage too low";
    case 0x0B:
      return "automatic release in progress";
    case 0x0C:
      return "internal fault";
    case 0x0D:
      return "activation fault";
    case 0x0E:
      return "overcurrent";
    case 0x0F:
      return "automatic release completed";
    default:
      return "unknown fault code " + std::to_string(fault);
  }
}

}  // namespace hogline::hw::robotiq
