// Modbus: any bytes as an answer, and any registers as a status of jaws and axes.
#include <algorithm>
#include <array>
#include <string>

#include "hw/modbus/axis_registers.hpp"
#include "hw/modbus/modbus_frames.hpp"
#include "hw/modbus/robotiq_registers.hpp"
#include "tests/fuzz/require.hpp"

namespace hogline::fuzz {
namespace {

using hw::modbus::Framing;
using hw::modbus::Verdict;

void decode(const std::vector<std::uint16_t>& values) {
  if (values.size() == 3) {
    hw::robotiq::Registers registers{};
    std::copy_n(values.begin(), 3, registers.begin());
    const auto status = hw::robotiq::decode(registers);
    require(!hw::robotiq::describe_fault(status.fault).empty(), "a fault has words");
    require(status.current_a >= 0.0 && status.current_a <= 2.5501, "the current is a byte of 10 mA");
  }
  if (values.size() == 8) {
    std::array<std::uint16_t, 8> registers{};
    std::copy_n(values.begin(), 8, registers.begin());
    const auto status = hw::axis::decode(registers);
    require(!hw::axis::describe_fault(status.fault).empty(), "a fault has words");
    const auto argument = hw::axis::rate_argument(hw::axis::rate_radps(status.actual));
    require(argument == status.actual, "a rate survives the round trip");
    require(hw::axis::next_sequence(status.sequence_echo) != 0, "no sequence is 0");
  }
}

void judge(std::vector<std::uint8_t> bytes, const hw::modbus::Request& request, Framing framing) {
  const auto answer = hw::modbus::judge(bytes, request, framing, 0x0102);
  require((answer.verdict == Verdict::wrong) == !answer.reason.empty(), "what is wrong has a reason");
  if (answer.verdict != Verdict::good) return;
  require(answer.values.size() == (request.writes() ? 0U : request.count), "a good answer has all registers");
  decode(answer.values);
  bytes.push_back(0);
  const auto longer = hw::modbus::judge(bytes, request, framing, 0x0102);
  require(longer.verdict == Verdict::wrong, "a good answer with a byte more is wrong");
  bytes.resize(bytes.size() - 2);
  const auto shorter = hw::modbus::judge(bytes, request, framing, 0x0102);
  require(shorter.verdict == Verdict::incomplete, "a good answer without its last byte is incomplete");
}

}  // namespace
}  // namespace hogline::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hogline::fuzz;
  if (size == 0) return 0;
  const std::uint8_t choice = data[0];
  const std::array<std::uint16_t, 3> command{0x0900, 0, 0xFFFF};
  const std::array requests{hogline::hw::modbus::read_input_registers(9, 0x07D0, 3),
                            hogline::hw::modbus::read_input_registers(10, 0x0200, 8),
                            hogline::hw::modbus::write_registers(9, 0x03E8, command),
                            hogline::hw::modbus::write_registers(11, 0x0103, std::span(command).first(1))};
  const auto& request = requests[choice & 0x03U];
  const auto framing = (choice & 0x04U) != 0 ? Framing::tcp : Framing::rtu;
  std::vector<std::uint8_t> bytes(data + 1, data + size);
  if (framing == Framing::rtu && (choice & 0x08U) != 0) {
    // A CRC that fits, so that what stands behind its check is reached.
    const auto crc = hogline::hw::modbus::crc16(bytes);
    bytes.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
    bytes.push_back(static_cast<std::uint8_t>(crc >> 8U));
  }
  judge(std::move(bytes), request, framing);
  return 0;
}
