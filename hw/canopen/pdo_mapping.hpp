// The order in which CiA 301 (7.5.2.36, 7.5.2.38) wants a PDO configured.
#pragma once

#include <cstdint>
#include <vector>

#include "hw/canopen/sdo.hpp"

namespace hogline::hw {

struct MappedObject {
  ObjectAddress address;
  std::uint8_t bits = 0;
};

enum class PdoDirection { receive, transmit };  ///< seen from the device

struct PdoConfig {
  PdoDirection direction = PdoDirection::receive;
  int number = 1;                      ///< 1..4
  std::uint32_t cob_id = 0;            ///< 11 bits
  std::vector<MappedObject> objects;   ///< 64 bits at most together
  std::uint8_t transmission_type = 1;  ///< 1..240 with every n-th SYNC, 254 and 255 by event
  std::uint16_t event_timer_ms = 0;    ///< of an RPDO: the device's own watchdog; 0 is off and is not written
};

/// COB-ID invalid (bit 31), count 0, entries, count, type, timer, COB-ID valid. For a node in pre-operational.
std::vector<SdoWrite> pdo_mapping_sequence(const PdoConfig& pdo);

/// Switches a PDO off, if the device has it at all.
SdoWrite pdo_disable(PdoDirection direction, int number, std::uint32_t cob_id);

}  // namespace hogline::hw
