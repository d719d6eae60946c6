#include "hw/modbus/modbus_frames.hpp"

#include <algorithm>
#include <cassert>

namespace hogline::hw::modbus {

namespace {

using Bytes = std::vector<std::uint8_t>;
using View = std::span<const std::uint8_t>;

constexpr std::uint8_t read_function = 4;
constexpr std::uint8_t write_function = 16;
constexpr std::uint8_t exception_flag = 0x80;
constexpr std::size_t header_size = 7;  // transaction, protocol, length, unit
constexpr std::size_t crc_size = 2;

void append(Bytes& bytes, std::uint16_t word) {
  bytes.push_back(static_cast<std::uint8_t>(word >> 8U));
  bytes.push_back(static_cast<std::uint8_t>(word & 0xFFU));
}

std::uint16_t word_at(View bytes, std::size_t place) {
  return static_cast<std::uint16_t>(bytes[place] << 8U | bytes[place + 1]);
}

// Function and data: what both framings have in common.
Bytes data_unit(const Request& request) {
  Bytes bytes{request.writes() ? write_function : read_function};
  append(bytes, request.address);
  append(bytes, request.count);
  if (!request.writes()) return bytes;
  bytes.push_back(static_cast<std::uint8_t>(2 * request.values.size()));
  for (const auto value : request.values) append(bytes, value);
  return bytes;
}

std::size_t answer_size(const Request& request, bool exception) {
  if (exception) return 2;
  return request.writes() ? 5 : 2 + 2 * static_cast<std::size_t>(request.count);
}

Answer wrong(std::string_view reason) { return {.verdict = Verdict::wrong, .reason = reason}; }

// A whole data unit of the right size and function.
Answer judge_data(View unit, const Request& request) {
  if ((unit[0] & exception_flag) != 0) {
    return {.verdict = Verdict::exception, .exception = unit[1]};
  }
  if (request.writes()) {
    if (word_at(unit, 1) != request.address) return wrong("another address is confirmed");
    if (word_at(unit, 3) != request.count) return wrong("another number of registers is confirmed");
    return {.verdict = Verdict::good};
  }
  if (unit[1] != 2 * request.count) return wrong("another number of registers is answered");
  Answer answer{.verdict = Verdict::good};
  for (std::size_t i = 0; i < request.count; ++i) answer.values.push_back(word_at(unit, 2 + 2 * i));
  return answer;
}

bool begins_with(View bytes, View start) {
  return bytes.size() >= start.size() && std::equal(start.begin(), start.end(), bytes.begin());
}

bool expected_function(std::uint8_t function, const Request& request) {
  return (function & ~exception_flag & 0xFFU) == (request.writes() ? write_function : read_function);
}

Answer judge_tcp(View bytes, const Request& request, std::uint16_t transaction) {
  // Checked as it arrives: what can not become right any more is wrong at once.
  if (bytes.size() >= 2 && word_at(bytes, 0) != transaction) return wrong("it answers another request");
  if (bytes.size() >= 4 && word_at(bytes, 2) != 0) return wrong("the protocol is not Modbus");
  if (bytes.size() >= header_size && bytes[header_size - 1] != request.unit) return wrong("another unit answers");
  if (bytes.size() <= header_size) return {};
  const View unit = bytes.subspan(header_size);
  if (!expected_function(unit[0], request)) return wrong("another function is answered");
  const std::size_t size = answer_size(request, (unit[0] & exception_flag) != 0);
  if (word_at(bytes, 4) != size + 1) return wrong("the length in the header is not that of the answer");
  if (unit.size() < size) return {};
  if (unit.size() > size) return wrong("bytes follow the answer");
  return judge_data(unit, request);
}

Answer judge_rtu(View bytes, const Request& request) {
  const Bytes sent = encode(request, Framing::rtu, 0);
  const bool echoed = begins_with(bytes, sent) || begins_with(sent, bytes);
  const auto wrong_here = [&](std::string_view reason) {
    return wrong(echoed ? "the line echoes what is sent: switch the adapter's local echo off" : reason);
  };
  if (begins_with(bytes, sent)) return wrong_here({});
  if (!bytes.empty() && bytes[0] != request.unit) return wrong("another unit answers, or noise");
  if (bytes.size() < 2) return {};
  if (!expected_function(bytes[1], request)) return wrong("another function is answered");
  const bool exception = (bytes[1] & exception_flag) != 0;
  if (bytes.size() < 3) return {};
  if (!exception && !request.writes() && bytes[2] != 2 * request.count) {
    return wrong_here("another number of registers is answered");
  }
  const std::size_t size = answer_size(request, exception);
  if (bytes.size() < 1 + size + crc_size) return {};
  const View covered = bytes.first(1 + size);
  const auto crc = static_cast<std::uint16_t>(bytes[1 + size] | bytes[2 + size] << 8U);
  if (crc16(covered) != crc) return wrong_here("the CRC is wrong");
  if (bytes.size() > 1 + size + crc_size) return wrong("bytes follow the answer");
  return judge_data(covered.subspan(1), request);
}

}  // namespace

Request read_input_registers(int unit, int address, std::size_t count) {
  assert(count >= 1 && count <= 125);
  return {.unit = static_cast<std::uint8_t>(unit),
          .address = static_cast<std::uint16_t>(address),
          .count = static_cast<std::uint16_t>(count)};
}

Request write_registers(int unit, int address, std::span<const std::uint16_t> values) {
  assert(!values.empty() && values.size() <= 123);
  return {.unit = static_cast<std::uint8_t>(unit),
          .address = static_cast<std::uint16_t>(address),
          .count = static_cast<std::uint16_t>(values.size()),
          .values = {values.begin(), values.end()}};
}

Bytes encode(const Request& request, Framing framing, std::uint16_t transaction) {
  const Bytes unit = data_unit(request);
  Bytes bytes;
  if (framing == Framing::tcp) {
    append(bytes, transaction);
    append(bytes, 0);
    append(bytes, static_cast<std::uint16_t>(unit.size() + 1));
  }
  bytes.push_back(request.unit);
  bytes.insert(bytes.end(), unit.begin(), unit.end());
  if (framing == Framing::rtu) {
    const auto crc = crc16(bytes);
    bytes.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
    bytes.push_back(static_cast<std::uint8_t>(crc >> 8U));
  }
  return bytes;
}

Answer judge(View bytes, const Request& request, Framing framing, std::uint16_t transaction) {
  return framing == Framing::tcp ? judge_tcp(bytes, request, transaction) : judge_rtu(bytes, request);
}

std::uint16_t crc16(View bytes) {
  std::uint16_t crc = 0xFFFF;
  for (const auto byte : bytes) {
    crc = static_cast<std::uint16_t>(crc ^ byte);
    for (int bit = 0; bit < 8; ++bit) {
      const bool out = (crc & 1U) != 0;
      crc = static_cast<std::uint16_t>(crc >> 1U);
      if (out) crc = static_cast<std::uint16_t>(crc ^ 0xA001U);
    }
  }
  return crc;
}

std::string_view exception_meaning(int code) {
  switch (code) {
    case 1:
      return "illegal function";
    case 2:
      return "illegal address";
    case 3:
      return "illegal value";
    case 4:
      return "device failure";
    case 5:
      return "acknowledged, not done yet";
    case 6:
      return "device busy";
    case 8:
      return "memory parity error";
    case 10:
      return "gateway path not available";
    case 11:
      return "gateway: the unit does not answer";
    default:
      return "unlisted exception";
  }
}

}  // namespace hogline::hw::modbus
