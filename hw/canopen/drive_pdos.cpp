#include "hw/canopen/drive_pdos.hpp"

#include <span>

#include "hw/canopen/cob_id.hpp"
#include "hw/canopen/little_endian.hpp"

namespace hogline::hw {
namespace {

constexpr MappedObject controlword{{0x6040, 0}, 16};
constexpr MappedObject statusword{{0x6041, 0}, 16};
constexpr MappedObject target_velocity{{0x60FF, 0}, 32};
constexpr MappedObject target_position{{0x607A, 0}, 32};
constexpr MappedObject mode{{0x6060, 0}, 8};
constexpr MappedObject actual_velocity{{0x606C, 0}, 32};
constexpr MappedObject actual_position{{0x6064, 0}, 32};
constexpr MappedObject mode_display{{0x6061, 0}, 8};
constexpr MappedObject error_code{{0x603F, 0}, 16};

constexpr std::uint8_t every_sync = 1;

}  // namespace

PdoConfig command_pdo_config(std::uint8_t node, std::uint16_t event_timer_ms) {
  return {PdoDirection::receive, 1, rpdo_cob_id(1, node), {controlword, target_velocity}, every_sync, event_timer_ms};
}

PdoConfig target_pdo_config(std::uint8_t node) {
  return {PdoDirection::receive, 2, rpdo_cob_id(2, node), {target_position, mode}, every_sync, 0};
}

PdoConfig status_pdo_config(std::uint8_t node) {
  return {PdoDirection::transmit, 1, tpdo_cob_id(1, node), {statusword, actual_velocity, mode_display}, every_sync, 0};
}

PdoConfig position_pdo_config(std::uint8_t node) {
  return {PdoDirection::transmit, 2, tpdo_cob_id(2, node), {actual_position, error_code}, every_sync, 0};
}

CanFrame encode(const DriveCommandPdo& pdo, std::uint8_t node) {
  CanFrame frame{.id = rpdo_cob_id(1, node), .length = 6, .data = {}};
  put_le(frame.data, pdo.controlword);
  put_le(std::span{frame.data}.subspan(2), pdo.target_velocity);
  return frame;
}

CanFrame encode(const DriveTargetPdo& pdo, std::uint8_t node) {
  CanFrame frame{.id = rpdo_cob_id(2, node), .length = 5, .data = {}};
  put_le(frame.data, pdo.position);
  frame.data[4] = static_cast<std::uint8_t>(pdo.mode);
  return frame;
}

std::optional<DriveStatusPdo> decode_status(const CanFrame& frame) {
  if (frame.length != 7) return std::nullopt;
  return DriveStatusPdo{get_le<std::uint16_t>(frame.data), get_le<std::int32_t>(std::span{frame.data}.subspan(2)),
                        static_cast<std::int8_t>(frame.data[6])};
}

std::optional<DrivePositionPdo> decode_position(const CanFrame& frame) {
  if (frame.length != 6) return std::nullopt;
  return DrivePositionPdo{get_le<std::int32_t>(frame.data), get_le<std::uint16_t>(std::span{frame.data}.subspan(4))};
}

}  // namespace hogline::hw
