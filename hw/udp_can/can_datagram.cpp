#include "hw/udp_can/can_datagram.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace hogline::hw {
namespace {

using nlohmann::json;

constexpr std::uint64_t most_standard_id = 0x7FF;
constexpr std::uint64_t most_extended_id = 0x1FFFFFFF;

// The value of a key that must be there and be of this type.
template <typename Value>
std::optional<Value> value_of(const json& map, const char* key, bool is_type) {
  return is_type ? std::optional<Value>(map.at(key).get<Value>()) : std::nullopt;
}

std::optional<bool> flag(const json& map, const char* key) {
  return map.contains(key) ? value_of<bool>(map, key, map.at(key).is_boolean()) : std::nullopt;
}

std::optional<std::uint64_t> number(const json& map, const char* key) {
  return map.contains(key) ? value_of<std::uint64_t>(map, key, map.at(key).is_number_unsigned()) : std::nullopt;
}

}  // namespace

std::vector<std::uint8_t> pack_can_frame(const CanFrame& frame, double unix_s) {
  const std::size_t bytes = frame.remote ? 0 : frame.length;
  const json map = {
      {"timestamp", unix_s},
      {"arbitration_id", frame.id},
      {"is_extended_id", frame.extended},
      {"is_remote_frame", frame.remote},
      {"is_error_frame", false},
      {"channel", nullptr},
      {"dlc", frame.length},
      {"data", json::binary({frame.data.begin(), frame.data.begin() + static_cast<std::ptrdiff_t>(bytes)})},
      {"is_fd", false},
      {"bitrate_switch", false},
      {"error_state_indicator", false}};
  return json::to_msgpack(map);
}

std::optional<CanFrame> unpack_can_frame(std::span<const std::uint8_t> datagram) {
  const json map = json::from_msgpack(datagram.begin(), datagram.end(), true, false);
  if (!map.is_object() || !map.contains("data") || !map.at("data").is_binary()) return std::nullopt;
  const auto id = number(map, "arbitration_id");
  const auto extended = flag(map, "is_extended_id");
  const auto remote = flag(map, "is_remote_frame");
  const auto length = number(map, "dlc");
  if (!id || !extended || !remote || !length || *length > 8) return std::nullopt;
  if (flag(map, "is_error_frame").value_or(false) || flag(map, "is_fd").value_or(false)) return std::nullopt;
  const json::binary_t& data = map.at("data").get_binary();
  if (*id > (*extended ? most_extended_id : most_standard_id)) return std::nullopt;
  if (data.size() != (*remote ? 0 : *length)) return std::nullopt;

  CanFrame frame{.id = static_cast<std::uint32_t>(*id),
                 .extended = *extended,
                 .remote = *remote,
                 .length = static_cast<std::uint8_t>(*length),
                 .data = {}};
  std::ranges::copy(data, frame.data.begin());
  return frame;
}

}  // namespace hogline::hw
