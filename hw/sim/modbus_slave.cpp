#include "hw/sim/modbus_slave.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace hogline::hw::sim {

namespace {

using View = std::span<const std::uint8_t>;

constexpr int read_holding = 3;
constexpr int read_input = 4;
constexpr int write_one = 6;
constexpr int write_many = 16;
constexpr int illegal_function = 1;
constexpr int illegal_address = 2;
constexpr int illegal_value = 3;
constexpr int no_such_unit = 11;

constexpr std::size_t fixed_size = 5;  // function, address, count or value
constexpr std::size_t values_at = 6;   // behind the byte count
constexpr int most_read = 125;
constexpr std::size_t most_written = 123;

int word_at(View bytes, std::size_t place) { return bytes[place] << 8 | bytes[place + 1]; }

void append(ModbusBytes& bytes, int word) {
  bytes.push_back(static_cast<std::uint8_t>(word >> 8));
  bytes.push_back(static_cast<std::uint8_t>(word & 0xFF));
}

// The values that a write carries; nothing when its lengths contradict each other.
std::optional<std::vector<std::uint16_t>> values_of(View request) {
  std::vector<std::uint16_t> values;
  if (request[0] == write_one) {
    if (request.size() != fixed_size) return std::nullopt;
    values.push_back(static_cast<std::uint16_t>(word_at(request, 3)));
    return values;
  }
  const auto count = static_cast<std::size_t>(word_at(request, 3));
  const bool fits = count >= 1 && count <= most_written && request.size() == values_at + 2 * count;
  if (!fits || request[values_at - 1] != 2 * count) return std::nullopt;
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(static_cast<std::uint16_t>(word_at(request, values_at + 2 * i)));
  }
  return values;
}

}  // namespace

ModbusSlave::ModbusSlave(std::vector<ModbusUnit> units) {
  for (auto& unit : units) {
    const auto holding = static_cast<std::size_t>(unit.holding_count);
    const auto inputs = static_cast<std::size_t>(unit.input_count);
    units_.push_back({std::move(unit), std::vector<std::uint16_t>(holding, 0), std::vector<std::uint16_t>(inputs, 0)});
  }
}

ModbusSlave::Registers* ModbusSlave::find(int number) {
  const auto it = std::ranges::find_if(units_, [&](const auto& u) { return u.unit.unit == number; });
  return it == units_.end() ? nullptr : &*it;
}

bool ModbusSlave::knows(int unit) const {
  return std::ranges::any_of(units_, [&](const auto& u) { return u.unit.unit == unit; });
}

ModbusBytes ModbusSlave::exception(View request, int code) {
  const unsigned function = request.empty() ? 0U : request[0];
  return {static_cast<std::uint8_t>(function | 0x80U), static_cast<std::uint8_t>(code)};
}

ModbusBytes ModbusSlave::answer(int number, View request) {
  auto* unit = find(number);
  if (unit == nullptr) return exception(request, no_such_unit);
  const int function = request.empty() ? 0 : request[0];
  const bool reads = function == read_holding || function == read_input;
  const bool writes = function == write_one || function == write_many;
  if (!reads && !writes) return exception(request, illegal_function);
  if (request.size() < fixed_size) return exception(request, illegal_value);
  return reads ? read(*unit, request) : write(*unit, request);
}

ModbusBytes ModbusSlave::read(Registers& unit, View request) {
  const bool holding = request[0] == read_holding;
  const int start = word_at(request, 1) - (holding ? unit.unit.holding_start : unit.unit.input_start);
  const int count = word_at(request, 3);
  const auto& values = holding ? unit.holding : unit.inputs;
  if (count < 1 || count > most_read || request.size() != fixed_size) return exception(request, illegal_value);
  if (start < 0 || start + count > static_cast<int>(values.size())) return exception(request, illegal_address);
  if (!holding && !frozen_) unit.unit.read_inputs(unit.inputs);
  ModbusBytes answer{request[0], static_cast<std::uint8_t>(2 * count)};
  for (int i = start; i < start + count; ++i) append(answer, values[static_cast<std::size_t>(i)]);
  return answer;
}

ModbusBytes ModbusSlave::write(Registers& unit, View request) {
  const auto values = values_of(request);
  if (!values) return exception(request, illegal_value);
  const int address = word_at(request, 1);
  const int start = address - unit.unit.holding_start;
  if (const int code = unit.unit.write(address, *values)) return exception(request, code);
  const auto count = static_cast<int>(values->size());
  if (start < 0 || start + count > unit.unit.holding_count) return exception(request, illegal_address);
  std::ranges::copy(*values, unit.holding.begin() + start);
  return {request.begin(), request.begin() + fixed_size};
}

}  // namespace hogline::hw::sim
