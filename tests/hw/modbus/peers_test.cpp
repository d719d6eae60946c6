// Foreign peers: our jaws client against a gripper served by pymodbus, and mbpoll against our simulated gripper.
#include <gtest/gtest.h>

#include <cstdio>
#include <memory>

#include "hw/modbus/robotiq_jaws.hpp"
#include "tests/hw/modbus/modbus_rig.hpp"
#include "tests/hw/peer.hpp"

namespace hogline::hw {
namespace {

std::string word_behind(const std::string& line, const std::string& start) {
  return line.starts_with(start) ? line.substr(start.size()) : std::string();
}

class ForeignGripper : public testing::TestWithParam<Wire> {
 protected:
  // The machine may be busy: what is waited for is an answer, however long it takes.
  static constexpr Duration patience = 20s;

  void start(bool holding) {
    std::vector<std::string> arguments{"/usr/bin/python3", HOGLINE_SOURCE_DIR "/tests/peers/robotiq_gripper.py",
                                       GetParam() == Wire::tcp ? "tcp" : "rtu"};
    if (holding) arguments.emplace_back("--holding");
    peer = std::make_unique<Peer>(arguments);
    const std::string where = word_behind(peer->hear(), "READY ");
    ModbusLineConfig line{.line = ModbusTcp{"127.0.0.1", 0}, .response_timeout = patience};
    if (GetParam() == Wire::tcp) {
      line.line = ModbusTcp{"127.0.0.1", std::stoi(where)};
    } else {
      line.line = ModbusRtu{.device = where, .baud = 115200, .parity = 'N', .data_bits = 8, .stop_bits = 1};
    }
    session = std::make_unique<ModbusSession>(ModbusSessionConfig{.line = line, .reconnect_delay = 200ms});
  }
  void step() { jaws.step(*session, now += 20ms); }
  template <typename Reached>
  bool reaches(Reached&& reached) {
    for (int i = 0; i < 100 && !reached(); ++i) step();
    return reached();
  }
  std::string error() const { return jaws.error() ? jaws.error()->what : "no error"; }
  // "key=value" of what the peer says of itself.
  std::string peers(const std::string& key) {
    const std::string line = " " + peer->ask("state") + " ";
    const auto start = line.find(" " + key + "=") + key.size() + 2;
    return line.substr(start, line.find(' ', start) - start);
  }

  std::unique_ptr<Peer> peer;
  std::unique_ptr<ModbusSession> session;
  RobotiqJaws jaws{jaws_config()};
  Stamp now{};
};

TEST_P(ForeignGripper, is_activated_grips_and_lets_go) {
  start(false);
  step();
  ASSERT_FALSE(jaws.error()) << error();
  jaws.grip();
  ASSERT_TRUE(reaches([&] { return jaws.activated(); })) << error();
  peer->ask("place");
  ASSERT_TRUE(reaches([&] { return jaws.jaws() == JawState::holding; })) << error();
  EXPECT_EQ(peers("stone"), "1");
  EXPECT_EQ(peers("position"), "189");
  jaws.release();
  ASSERT_TRUE(reaches([&] { return jaws.jaws() == JawState::open; })) << error();
  EXPECT_TRUE(jaws.opening_since());
  EXPECT_EQ(peers("stone"), "0");
  EXPECT_EQ(peers("writes"), "3") << "activate, close, open: each once";
  EXPECT_FALSE(jaws.error()) << error();
}

TEST_P(ForeignGripper, that_holds_a_stone_is_read_and_not_touched) {
  start(true);
  ASSERT_TRUE(reaches([&] { return jaws.jaws() == JawState::holding; })) << error();
  EXPECT_EQ(peers("writes"), "0");
  peer->ask("fault 0E");
  step();
  ASSERT_TRUE(jaws.error());
  EXPECT_EQ(jaws.error()->kind, DeviceErrorKind::device_fault);
  EXPECT_NE(jaws.error()->what.find("overcurrent"), std::string::npos) << jaws.error()->what;
  jaws.release();
  step();
  EXPECT_EQ(peers("writes"), "0") << "no order while an error is latched";
  EXPECT_EQ(peers("stone"), "1");

  peer->ask("fault 00");
  jaws.rearm();
  ASSERT_TRUE(reaches([&] { return jaws.jaws() == JawState::holding; })) << error();
  peer->ask("lose");
  ASSERT_TRUE(reaches([&] { return jaws.error().has_value(); }));
  EXPECT_EQ(peers("activations"), "0");
}

INSTANTIATE_TEST_SUITE_P(wires, ForeignGripper, testing::Values(Wire::tcp, Wire::rtu),
                         [](const auto& wire) { return wire.param == Wire::tcp ? "tcp" : "rtu"; });

// The output of a command that must succeed.
std::string output_of(const std::string& command) {
  std::string text;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return text;
  for (int c = fgetc(pipe); c != EOF; c = fgetc(pipe)) text += static_cast<char>(c);
  EXPECT_EQ(pclose(pipe), 0) << command << '\n' << text;
  return text;
}

TEST(Mbpoll, reads_and_opens_our_simulated_gripper_over_tcp) {
  Rig rig;
  const std::string line = "-m tcp -p " + std::to_string(rig.devices.port()) + " -a 9 -0 -o 10 ";
  const auto status = output_of("mbpoll -1 -q -t 3:hex -r 2000 -c 3 " + line + "127.0.0.1");
  EXPECT_NE(status.find("[2000]: \t0xB900"), std::string::npos) << status;
  EXPECT_NE(status.find("[2001]: \t0x00FF"), std::string::npos) << status;
  EXPECT_NE(status.find("[2002]: \t0xBD10"), std::string::npos) << status;
  output_of("mbpoll -1 -q -t 4:hex -r 1000 " + line + "127.0.0.1 0x0900 0x0000 0xFFFF");
  EXPECT_TRUE(rig.devices.effects().stone_free_at) << "it opens";
  const auto command = output_of("mbpoll -1 -q -t 4:hex -r 1000 -c 3 " + line + "127.0.0.1");
  EXPECT_NE(command.find("[1002]: \t0xFFFF"), std::string::npos) << command;
}

TEST(Mbpoll, reads_our_simulated_devices_over_rtu) {
  Rig rig({.wire = Wire::rtu});
  const std::string line = "-m rtu -b 115200 -P none -0 -o 10 ";
  const auto jaws = output_of("mbpoll -1 -q -a 9 -t 3:hex -r 2000 -c 3 " + line + rig.devices.rtu_path());
  EXPECT_NE(jaws.find("[2000]: \t0xB900"), std::string::npos) << jaws;
  const auto arm = output_of("mbpoll -1 -q -a 11 -t 3:hex -r 512 -c 8 " + line + rig.devices.rtu_path());
  EXPECT_NE(arm.find("[512]: \t0x4131"), std::string::npos) << arm;
  EXPECT_NE(arm.find("[515]: \t0x0016"), std::string::npos) << arm << "at its target, watchdog tripped, folded";
}

}  // namespace
}  // namespace hogline::hw
