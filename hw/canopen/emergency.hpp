// The emergency object (EMCY) of CiA 301, 7.2.7: a device's own cry.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "hw/can_bus.hpp"

namespace hogline::hw {

struct Emergency {
  std::uint8_t node = 0;
  std::uint16_t code = 0;           ///< 0000: error reset, no error
  std::uint8_t error_register = 0;  ///< copy of object 1001
  std::array<std::uint8_t, 5> manufacturer{};
};

/// Nothing if the frame is not eight bytes on 081..0FF.
std::optional<Emergency> decode_emergency(const CanFrame& frame);

/// The code's meaning: the exact one where the standard names it, else its class (first digits).
const char* emergency_meaning(std::uint16_t code);

/// "EMCY 8130 (heartbeat of the master lost), register 11".
std::string describe(const Emergency& emergency);

}  // namespace hogline::hw
