#include "hw/canopen/emergency.hpp"

#include <algorithm>
#include <cstdio>

#include "hw/canopen/cob_id.hpp"
#include "hw/canopen/little_endian.hpp"

namespace hogline::hw {
namespace {

struct Meaning {
  std::uint16_t code;
  std::uint16_t mask;
  const char* text;
};

// From the most exact to the class. CiA 301 table 26, CiA 402 for the 2xxx..7xxx of drives.
constexpr Meaning meanings[] = {
    {0x0000, 0xFFFF, "no error"},
    {0x8110, 0xFFFF, "CAN overrun, frames lost"},
    {0x8120, 0xFFFF, "CAN error passive"},
    {0x8130, 0xFFFF, "heartbeat of the master lost"},
    {0x8140, 0xFFFF, "recovered from bus-off"},
    {0x8210, 0xFFFF, "PDO not processed, too short"},
    {0x8220, 0xFFFF, "PDO too long"},
    {0x8250, 0xFFFF, "RPDO timeout"},
    {0x1000, 0xFF00, "generic error"},
    {0x2000, 0xF000, "current"},
    {0x3000, 0xF000, "voltage"},
    {0x4000, 0xF000, "temperature"},
    {0x5000, 0xF000, "device hardware"},
    {0x6000, 0xF000, "device software"},
    {0x7000, 0xF000, "additional modules: motor, brake, encoder"},
    {0x8100, 0xFF00, "communication"},
    {0x8200, 0xFF00, "protocol"},
    {0x8000, 0xF000, "monitoring"},
    {0x9000, 0xF000, "external error"},
    {0xF000, 0xF000, "additional functions"},
};

}  // namespace

std::optional<Emergency> decode_emergency(const CanFrame& frame) {
  if (!is_canopen_frame(frame) || frame.length != 8) return std::nullopt;
  if (frame.id <= 0x080 || frame.id > 0x0FF) return std::nullopt;
  Emergency emergency{.node = static_cast<std::uint8_t>(frame.id - 0x080),
                      .code = get_le<std::uint16_t>(frame.data),
                      .error_register = frame.data[2]};
  std::copy(frame.data.begin() + 3, frame.data.end(), emergency.manufacturer.begin());
  return emergency;
}

const char* emergency_meaning(std::uint16_t code) {
  for (const Meaning& meaning : meanings) {
    if ((code & meaning.mask) == meaning.code) return meaning.text;
  }
  return "manufacturer specific";
}

std::string describe(const Emergency& emergency) {
  char text[96];
  std::snprintf(text, sizeof text, "EMCY %04X (%s), register %02X", unsigned{emergency.code},
                emergency_meaning(emergency.code), unsigned{emergency.error_register});
  return text;
}

}  // namespace hogline::hw
