#include "hw/sim/modbus_wire.hpp"

#include <span>

namespace hogline::hw::sim {

namespace {

constexpr std::size_t header_size = 6;  // transaction, protocol, length; the unit is the first byte that is counted
constexpr std::size_t largest_length = 254;

// Bit by bit, as the standard's appendix describes it: shift right, and xor A001 when a one falls out.
unsigned crc_of(std::span<const std::uint8_t> bytes) {
  unsigned crc = 0xFFFFU;
  for (const unsigned byte : bytes) {
    crc ^= byte;
    for (int i = 0; i < 8; ++i) crc = (crc & 1U) != 0 ? (crc >> 1U) ^ 0xA001U : crc >> 1U;
  }
  return crc;
}

std::optional<ModbusRequest> take_tcp(ModbusBytes& bytes) {
  if (bytes.size() < header_size) return std::nullopt;
  const std::size_t length = static_cast<std::size_t>(bytes[4]) << 8U | bytes[5];
  if (bytes[2] != 0 || bytes[3] != 0 || length < 2 || length > largest_length) {
    bytes.clear();
    return std::nullopt;
  }
  if (bytes.size() < header_size + length) return std::nullopt;
  const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(header_size + length);
  ModbusRequest request{.unit = bytes[header_size],
                        .data = {bytes.begin() + header_size + 1, end},
                        .header = {bytes.begin(), bytes.begin() + 4},
                        .raw = {bytes.begin(), end}};
  bytes.erase(bytes.begin(), end);
  return request;
}

std::optional<ModbusRequest> take_rtu(ModbusBytes& bytes) {
  if (bytes.size() < 8) return std::nullopt;
  const unsigned function = bytes[1];
  std::size_t size = 8;
  if (function == 15 || function == 16) {
    size = 9U + bytes[6];
  } else if (function == 0 || function > 6) {
    bytes.clear();
    return std::nullopt;
  }
  if (bytes.size() < size) return std::nullopt;
  const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(size);
  ModbusRequest request{
      .unit = bytes[0], .data = {bytes.begin() + 1, end - 2}, .header = {}, .raw = {bytes.begin(), end}};
  const unsigned crc = bytes[size - 2] | static_cast<unsigned>(bytes[size - 1]) << 8U;
  if (crc != crc_of({bytes.data(), size - 2})) {
    bytes.clear();
    return std::nullopt;
  }
  bytes.erase(bytes.begin(), end);
  return request;
}

}  // namespace

std::optional<ModbusRequest> take_request(ModbusWire wire, ModbusBytes& bytes) {
  return wire == ModbusWire::tcp ? take_tcp(bytes) : take_rtu(bytes);
}

ModbusBytes wrap_answer(ModbusWire wire, const ModbusRequest& request, const ModbusBytes& data) {
  ModbusBytes answer = request.header;
  if (wire == ModbusWire::tcp) {
    answer.push_back(0);
    answer.push_back(static_cast<std::uint8_t>(data.size() + 1));
  }
  answer.push_back(static_cast<std::uint8_t>(request.unit));
  answer.insert(answer.end(), data.begin(), data.end());
  if (wire == ModbusWire::rtu) {
    const unsigned crc = crc_of(answer);
    answer.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
    answer.push_back(static_cast<std::uint8_t>(crc >> 8U));
  }
  return answer;
}

}  // namespace hogline::hw::sim
