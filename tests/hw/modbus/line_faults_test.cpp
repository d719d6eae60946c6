// Every fault of a Modbus line, over TCP and over RTU: found within its deadline, the stone stays held, belt and arm
// stop by their watchdogs, and nothing moves before it is re-armed and ordered anew.
#include <gtest/gtest.h>

#include <cctype>

#include "tests/hw/modbus/modbus_rig.hpp"

namespace hogline::hw {
namespace {

using Bytes = sim::ModbusBytes;
using Faults = sim::ModbusServerFaults;
using enum DeviceErrorKind;

struct LineFault {
  const char* what;
  Wire wire;
  Faults faults;  ///< all false: the server dies
  DeviceErrorKind kind;
};

Faults tampering(std::function<void(Bytes& answer)> change) {
  return {.tamper = [change](const Bytes&, Bytes answer) {
    change(answer);
    return answer;
  }};
}

// Gives a changed RTU answer the CRC that fits it: the fault is another one then.
void mend_crc(Bytes& answer) {
  unsigned crc = 0xFFFFU;
  for (std::size_t i = 0; i + 2 < answer.size(); ++i) {
    crc ^= answer[i];
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? (crc >> 1U) ^ 0xA001U : crc >> 1U;
  }
  answer[answer.size() - 2] = static_cast<std::uint8_t>(crc & 0xFFU);
  answer[answer.size() - 1] = static_cast<std::uint8_t>(crc >> 8U);
}

const std::vector<LineFault>& line_faults() {
  static const std::vector<LineFault> faults{
      {"the server dies", Wire::tcp, {}, disconnected},
      {"it accepts but never answers", Wire::tcp, {.stalled = true}, timeout},
      {"it carries out but never answers", Wire::tcp, {.silent = true}, timeout},
      {"each answer is late", Wire::tcp, {.late = true}, timeout},
      {"the connection is half open", Wire::tcp, {.half_open = true}, timeout},
      {"reset in the middle of a frame", Wire::tcp, {.reset_mid_frame = true}, disconnected},
      {"exception 6 busy", Wire::tcp, {.exception = 6}, refused},
      {"exception 4 device failure", Wire::tcp, {.exception = 4}, device_fault},
      {"the answer is cut short", Wire::tcp, tampering([](Bytes& a) { a.pop_back(); }), timeout},
      {"wrong transaction", Wire::tcp, tampering([](Bytes& a) { a[1] ^= 0x01; }), protocol},
      {"wrong protocol", Wire::tcp, tampering([](Bytes& a) { a[3] ^= 0x01; }), protocol},
      {"wrong length", Wire::tcp, tampering([](Bytes& a) { a[5] ^= 0x01; }), protocol},
      {"wrong unit", Wire::tcp, tampering([](Bytes& a) { a[6] ^= 0x40; }), protocol},
      {"wrong function", Wire::tcp, tampering([](Bytes& a) { a[7] = 3; }), protocol},
      {"wrong number of registers", Wire::tcp, tampering([](Bytes& a) { a[8] ^= 0x02; }), protocol},
      {"bytes follow", Wire::tcp, tampering([](Bytes& a) { a.push_back(0); }), protocol},
      {"the adapter is unplugged", Wire::rtu, {}, disconnected},
      {"it never answers", Wire::rtu, {.stalled = true}, timeout},
      {"each answer is late", Wire::rtu, {.late = true}, timeout},
      {"the answer is cut short", Wire::rtu, tampering([](Bytes& a) { a.pop_back(); }), timeout},
      {"half an answer", Wire::rtu, {.reset_mid_frame = true}, timeout},
      {"exception 6 busy", Wire::rtu, {.exception = 6}, refused},
      {"exception 4 device failure", Wire::rtu, {.exception = 4}, device_fault},
      {"wrong CRC", Wire::rtu, tampering([](Bytes& a) { a.back() ^= 0x10; }), protocol},
      {"a damaged bit", Wire::rtu, tampering([](Bytes& a) { a[3] ^= 0x08; }), protocol},
      {"noise before the answer", Wire::rtu, tampering([](Bytes& a) {
         a.insert(a.begin(), {0xFF, 0x00});
       }),
       protocol},
      {"noise behind the answer", Wire::rtu, tampering([](Bytes& a) { a.push_back(0x00); }), protocol},
      {"the line echoes",
       Wire::rtu,
       {.tamper =
            [](const Bytes& request, const Bytes& answer) {
              Bytes both = request;
              both.insert(both.end(), answer.begin(), answer.end());
              return both;
            }},
       protocol},
      {"wrong unit", Wire::rtu, tampering([](Bytes& a) {
         a[0] ^= 0x40;
         mend_crc(a);
       }),
       protocol},
      {"wrong function", Wire::rtu, tampering([](Bytes& a) {
         a[1] = 3;
         mend_crc(a);
       }),
       protocol},
      {"wrong number of registers", Wire::rtu, tampering([](Bytes& a) {
         a[2] ^= 0x02;
         mend_crc(a);
       }),
       protocol},
  };
  return faults;
}

std::string name_of(const testing::TestParamInfo<LineFault>& info) {
  std::string name = info.param.wire == Wire::tcp ? "tcp_" : "rtu_";
  for (const char* c = info.param.what; *c != '\0'; ++c) name += std::isalnum(*c) != 0 ? *c : '_';
  return name;
}

void PrintTo(const LineFault& fault, std::ostream* out) { *out << fault.what; }

class ModbusLine : public testing::TestWithParam<LineFault> {};

TEST_P(ModbusLine, fault_keeps_the_stone_and_moves_nothing_until_rearmed) {
  const auto& fault = GetParam();
  const bool dies = fault.kind == disconnected && !fault.faults.reset_mid_frame;
  // Silence is waited for by the machine's clock: few attempts, and long enough for a busy machine to
  // answer where it is not the fault. Every other fault is told by bytes.
  Rig rig({.reconnect_delay = 300ms, .wire = fault.wire, .response_timeout = fault.kind == timeout ? 1s : 20s});
  rig.gripper.spin(1.0);
  rig.arm.unfold();
  rig.run(500ms);
  ASSERT_FALSE(rig.gripper.state().error) << rig.gripper.state().error->what;
  ASSERT_FALSE(rig.arm.state().error);

  const Stamp injected = rig.now;
  if (dies) rig.devices.stop();
  rig.devices.set_faults(fault.faults);
  rig.run(100ms);  // the deadline: silence limit, poll period, and a step more
  ASSERT_EQ(kind_of(rig.gripper.state().error), fault.kind) << rig.gripper.state().error->what;
  EXPECT_EQ(kind_of(rig.arm.state().error), fault.kind) << rig.arm.state().error->what;
  EXPECT_LE(rig.arm.state().stamp, injected + 5ms) << "no wrong answer counts as news";
  RecordProperty("detected_after_ms", static_cast<int>(1e3 * seconds(rig.gripper.state().error->since - injected)));
  rig.gripper.release();  // an order into a dead line is dropped, not kept
  rig.arm.unfold();
  rig.run(450ms);
  EXPECT_EQ(rig.devices.effects().belt_radps, 0.0) << "stopped by its watchdog";
  const double place = rig.devices.effects().arm_unfolded;

  rig.devices.set_faults({});
  if (dies) rig.revive();
  rig.run(500ms);
  EXPECT_TRUE(rig.gripper.state().error) << "latched";
  EXPECT_TRUE(rig.stone_held());
  EXPECT_EQ(rig.devices.effects().belt_radps, 0.0);
  EXPECT_EQ(rig.devices.effects().arm_unfolded, place);

  rig.gripper.rearm();
  rig.arm.rearm();
  rig.run(500ms);
  EXPECT_FALSE(rig.gripper.state().error) << rig.gripper.state().error->what;
  EXPECT_FALSE(rig.arm.state().error);
  EXPECT_EQ(rig.gripper.state().jaws, JawState::holding);
  EXPECT_LE(seconds(rig.now - rig.gripper.state().stamp), 0.02) << "fresh again";
  EXPECT_EQ(rig.devices.effects().belt_radps, 0.0) << "re-arming alone moves nothing";
  EXPECT_EQ(rig.devices.effects().arm_unfolded, place);

  rig.gripper.spin(1.0);
  rig.arm.unfold();
  rig.run(2s);
  EXPECT_NEAR(rig.gripper.state().spin_radps, 1.0, 1e-3);
  EXPECT_EQ(rig.arm.state().position, ArmPosition::unfolded);
  rig.gripper.release();
  rig.run(1s);
  EXPECT_FALSE(rig.stone_held());
}

INSTANTIATE_TEST_SUITE_P(faults, ModbusLine, testing::ValuesIn(line_faults()), name_of);

TEST(ModbusLine, one_lost_answer_is_forgiven) {
  Rig rig({.reconnect_delay = 20ms});
  rig.run(100ms);
  rig.devices.stall();
  rig.run(5ms);
  rig.devices.set_faults({});
  rig.run(500ms);
  EXPECT_FALSE(rig.gripper.state().error);
  EXPECT_EQ(rig.session.connections(), 2U) << "the line was opened anew: no late answer can follow";
}

TEST(ModbusLine, one_damaged_answer_is_forgiven_on_a_serial_line) {
  Rig rig({.reconnect_delay = 20ms, .wire = Wire::rtu});
  rig.run(100ms);
  rig.devices.set_faults(tampering([](Bytes& a) { a[3] ^= 0x08; }));
  rig.run(5ms);
  rig.devices.set_faults({});
  rig.run(500ms);
  EXPECT_FALSE(rig.gripper.state().error) << rig.gripper.state().error->what;
}

TEST(ModbusLine, an_echo_is_called_by_its_name) {
  Rig rig({.wire = Wire::rtu});
  rig.run(100ms);
  rig.devices.set_faults({.tamper = [](const Bytes& request, const Bytes&) { return request; }});
  rig.run(100ms);
  ASSERT_TRUE(rig.gripper.state().error);
  EXPECT_NE(rig.gripper.state().error->what.find("echo"), std::string::npos) << rig.gripper.state().error->what;
}

TEST(ModbusLine, a_serial_line_that_comes_back_under_another_name_is_found_by_its_link) {
  Rig rig({.wire = Wire::rtu});
  rig.run(100ms);
  rig.devices.stop();
  rig.run(300ms);
  rig.revive();
  rig.run(300ms);  // it connects while the error is still latched
  rig.gripper.rearm();
  rig.arm.rearm();
  rig.run(500ms);
  EXPECT_FALSE(rig.gripper.state().error) << rig.gripper.state().error->what;
  EXPECT_EQ(rig.gripper.state().jaws, JawState::holding);
}

}  // namespace
}  // namespace hogline::hw
