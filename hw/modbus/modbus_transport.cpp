#include "hw/modbus/modbus_transport.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace hogline::hw {

namespace {

constexpr int device_failure = 4;  // the exception code by which a device says that it is broken
constexpr std::size_t longest_answer = 260;

}  // namespace

ModbusTransport::ModbusTransport(std::unique_ptr<ModbusLine> line, modbus::Framing framing)
    : line_(std::move(line)), framing_(framing) {}

std::optional<ModbusFault> ModbusTransport::open() {
  auto fault = line_->open();
  open_ = !fault;
  return fault;
}

void ModbusTransport::close() {
  line_->close();
  open_ = false;
}

std::variant<modbus::Answer, ModbusFault> ModbusTransport::exchange(const modbus::Request& request) {
  if (!open_) return ModbusFault{DeviceErrorKind::disconnected, "no connection"};
  line_->begin();
  if (auto fault = line_->send(modbus::encode(request, framing_, ++transaction_))) return *fault;
  return receive(request);
}

std::variant<modbus::Answer, ModbusFault> ModbusTransport::receive(const modbus::Request& request) {
  std::array<std::uint8_t, longest_answer> buffer{};
  for (std::size_t filled = 0; filled < buffer.size();) {
    auto got = line_->receive(std::span(buffer).subspan(filled));
    if (auto* fault = std::get_if<ModbusFault>(&got)) {
      if (fault->kind == DeviceErrorKind::timeout) fault->what = filled == 0 ? "no answer" : "the answer is cut short";
      return std::move(*fault);
    }
    filled += std::get<std::size_t>(got);
    auto answer = modbus::judge({buffer.data(), filled}, request, framing_, transaction_);
    if (answer.verdict == modbus::Verdict::wrong) {
      return ModbusFault{DeviceErrorKind::protocol, std::string(answer.reason)};
    }
    if (answer.verdict == modbus::Verdict::exception) {
      return ModbusFault{answer.exception == device_failure ? DeviceErrorKind::device_fault : DeviceErrorKind::refused,
                         "exception " + std::to_string(answer.exception) + ": " +
                             std::string(modbus::exception_meaning(answer.exception))};
    }
    if (answer.verdict == modbus::Verdict::good) return answer;
  }
  return ModbusFault{DeviceErrorKind::protocol, "it is longer than any answer"};
}

std::optional<ModbusFault> ModbusTransport::read_input(int unit, int address, std::span<std::uint16_t> values) {
  auto result = exchange(modbus::read_input_registers(unit, address, values.size()));
  if (auto* fault = std::get_if<ModbusFault>(&result)) return std::move(*fault);
  std::ranges::copy(std::get<modbus::Answer>(result).values, values.begin());
  return std::nullopt;
}

std::optional<ModbusFault> ModbusTransport::write(int unit, int address, std::span<const std::uint16_t> values) {
  auto result = exchange(modbus::write_registers(unit, address, values));
  if (auto* fault = std::get_if<ModbusFault>(&result)) return std::move(*fault);
  return std::nullopt;
}

}  // namespace hogline::hw
