// The PDOs of a drive: layout (doc/bus_maps.md), encoding, decoding. A wheel has no RPDO2.
#pragma once

#include <cstdint>
#include <optional>

#include "hw/can_bus.hpp"
#include "hw/canopen/cia402.hpp"
#include "hw/canopen/pdo_mapping.hpp"

namespace hogline::hw {

/// RPDO1: controlword 6040 u16, target velocity 60FF i32.
struct DriveCommandPdo {
  std::uint16_t controlword = static_cast<std::uint16_t>(Cia402Command::quick_stop);
  std::int32_t target_velocity = 0;
};

/// RPDO2: target position 607A i32, mode 6060 i8.
struct DriveTargetPdo {
  std::int32_t position = 0;
  std::int8_t mode = 0;
};

/// TPDO1: statusword 6041 u16, velocity 606C i32, mode display 6061 i8.
struct DriveStatusPdo {
  std::uint16_t statusword = 0;
  std::int32_t velocity = 0;
  std::int8_t mode = 0;
};

/// TPDO2: position 6064 i32, error code 603F u16.
struct DrivePositionPdo {
  std::int32_t position = 0;
  std::uint16_t error_code = 0;
};

inline constexpr std::int8_t profile_position_mode = 1;
inline constexpr std::int8_t cyclic_sync_velocity_mode = 9;

PdoConfig command_pdo_config(std::uint8_t node, std::uint16_t event_timer_ms);
PdoConfig target_pdo_config(std::uint8_t node);
PdoConfig status_pdo_config(std::uint8_t node);
PdoConfig position_pdo_config(std::uint8_t node);

CanFrame encode(const DriveCommandPdo& pdo, std::uint8_t node);
CanFrame encode(const DriveTargetPdo& pdo, std::uint8_t node);
/// Nothing if the length is not the mapped one.
std::optional<DriveStatusPdo> decode_status(const CanFrame& frame);
std::optional<DrivePositionPdo> decode_position(const CanFrame& frame);

}  // namespace hogline::hw
