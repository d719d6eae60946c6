#include "hw/canopen/pdo_mapping.hpp"

namespace hogline::hw {
namespace {

constexpr std::uint32_t pdo_invalid = 0x80000000;
constexpr std::uint32_t no_remote_request = 0x40000000;  // bit 30 exists only in a TPDO's COB-ID

std::uint16_t communication_index(PdoDirection direction, int number) {
  return static_cast<std::uint16_t>((direction == PdoDirection::receive ? 0x1400 : 0x1800) + number - 1);
}

std::uint16_t mapping_index(PdoDirection direction, int number) {
  return static_cast<std::uint16_t>((direction == PdoDirection::receive ? 0x1600 : 0x1A00) + number - 1);
}

std::uint32_t cob_id_entry(PdoDirection direction, std::uint32_t cob_id) {
  return direction == PdoDirection::transmit ? cob_id | no_remote_request : cob_id;
}

std::uint32_t mapping_entry(const MappedObject& object) {
  return (std::uint32_t{object.address.index} << 16) | (std::uint32_t{object.address.sub} << 8) | object.bits;
}

}  // namespace

std::vector<SdoWrite> pdo_mapping_sequence(const PdoConfig& pdo) {
  const std::uint16_t communication = communication_index(pdo.direction, pdo.number);
  const std::uint16_t mapping = mapping_index(pdo.direction, pdo.number);
  const std::uint32_t cob_id = cob_id_entry(pdo.direction, pdo.cob_id);

  std::vector<SdoWrite> writes;
  writes.push_back({{communication, 1}, cob_id | pdo_invalid, 4});
  writes.push_back({{mapping, 0}, 0, 1});
  std::uint8_t sub = 0;
  for (const MappedObject& object : pdo.objects) writes.push_back({{mapping, ++sub}, mapping_entry(object), 4});
  writes.push_back({{mapping, 0}, sub, 1});
  writes.push_back({{communication, 2}, pdo.transmission_type, 1});
  if (pdo.event_timer_ms > 0) writes.push_back({{communication, 5}, pdo.event_timer_ms, 2});
  writes.push_back({{communication, 1}, cob_id, 4});
  return writes;
}

SdoWrite pdo_disable(PdoDirection direction, int number, std::uint32_t cob_id) {
  const std::uint32_t entry = cob_id_entry(direction, cob_id) | pdo_invalid;
  return {{communication_index(direction, number), 1}, entry, 4, true};
}

}  // namespace hogline::hw
