// Foreign nodes on the bus (tests/peers/canopen_node.py, python-can): golden traces byte for byte, then our SDO client
// and our drive adapter against them.
#include <cmath>
#include <csignal>
#include <fstream>
#include <map>
#include <memory>

#include "hw/canopen/nmt.hpp"
#include "hw/canopen/sdo_client.hpp"
#include "hw/canopen/two_wheel_drive.hpp"
#include "hw/socketcan/bcm_cyclic.hpp"
#include "hw/socketcan/candump_log.hpp"
#include "tests/hil/can_node.hpp"
#include "tests/hil/drive_program.hpp"
#include "tests/hil/hil.hpp"
#include "tests/hil/process.hpp"

using namespace hogline;
using namespace hogline::hw;
using namespace hogline::hil;

namespace {

// "605#40..." as it stands in a log.
CanFrame frame(const std::string& text) {
  const CandumpLine line = decode_candump_line("(0.000000) x " + text);
  EXPECT_TRUE(line.record) << text << ": " << line.reason;
  return line.record ? line.record->frame : CanFrame{};
}

std::string text(const CanFrame& received) {
  const std::string line = encode_candump_line({{}, "x", received});
  return line.substr(line.rfind(' ') + 1);
}

// One program with three nodes for all tests (it takes seconds to start); each test resets them.
class PythonNode : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    nodes_ = std::make_unique<Process>(std::vector<std::string>{HOGLINE_SOURCE_DIR "/tests/peers/canopen_node.py",
                                                                "--channel", "vcan0", "--node", "1", "--node", "2",
                                                                "--node", "5"});
    SocketCanBus bus = running_bus();
    started_ = heard(bus, "705#00");
  }
  static void TearDownTestSuite() { nodes_.reset(); }

  void SetUp() override {
    ASSERT_TRUE(started_) << "canopen_node.py never sent its boot-up messages";
    SocketCanBus bus = running_bus();
    ASSERT_TRUE(wait_until([&] {  // a peer that was overrun may miss one
      EXPECT_EQ(bus.send(frame("000#8100")), CanSendResult::sent);
      return heard(bus, "705#00", 5s);
    }));
  }

  static SocketCanBus running_bus(SocketCanConfig config = {}) {
    config.interface = "vcan0";
    SocketCanBus bus(std::move(config), now());
    EXPECT_TRUE(run_until(bus, [&] { return bus.up(); }));
    return bus;
  }

  // The next frame that is no heartbeat.
  static std::string answer(SocketCanBus& bus) {
    for (const Stamp end = now() + generous; now() < end;) {
      const auto received = receive(bus, 1);
      if (!received.empty() && (received[0].frame.id & 0x780) != 0x700) return text(received[0].frame);
    }
    return "nothing";
  }

  static bool heard(SocketCanBus& bus, const std::string& expected, Duration limit = generous) {
    const auto came = [&] {
      for (const auto& received : period(bus))
        if (text(received.frame) == expected) return true;
      return false;
    };
    return wait_until(came, limit);
  }

 private:
  static inline std::unique_ptr<Process> nodes_;
  static inline bool started_ = false;
};

TEST_F(PythonNode, AnswersTheGoldenTraceByteForByte) {
  SocketCanBus bus = running_bus();

  const std::vector<std::pair<std::string, std::string>> golden{
      {"605#2F60600009000000", "585#6060600000000000"}, {"605#2B40600006000000", "585#6040600000000000"},
      {"605#23FF600018FCFFFF", "585#60FF600000000000"}, {"605#40FF600000000000", "585#43FF600018FCFFFF"},
      {"605#4008100000000000", "585#410810000F000000"}, {"605#6000000000000000", "585#004355524C494E47"},
      {"605#7000000000000000", "585#1020445249564520"}, {"605#6000000000000000", "585#0D31000000000000"},
      {"605#2300100000000000", "585#8000100002000106"},
  };
  for (const auto& [request, expected] : golden) {
    ASSERT_EQ(bus.send(frame(request)), CanSendResult::sent);
    EXPECT_EQ(answer(bus), expected) << request;
  }

  ASSERT_EQ(bus.send(frame("605#2B17100014000000")), CanSendResult::sent) << "heartbeat every 20 ms";
  EXPECT_TRUE(heard(bus, "705#7F"));
  ASSERT_EQ(bus.send(frame("000#0105")), CanSendResult::sent);
  EXPECT_TRUE(heard(bus, "705#05"));
  ASSERT_EQ(bus.send(frame("000#0205")), CanSendResult::sent);
  EXPECT_TRUE(heard(bus, "705#04"));
  ASSERT_EQ(bus.send(frame("000#8205")), CanSendResult::sent);
  EXPECT_TRUE(heard(bus, "705#00")) << "reset communication boots anew";
}

// Carries one transfer out.
SdoResult transfer(SocketCanBus& bus, SdoClient& client) {
  std::optional<SdoResult> result;
  wait_until([&] {
    for (const auto& received : period(bus))
      if (received.frame.id == 0x585) client.on_frame(received.frame, now());
    client.step(now());
    while (const auto request = client.take_frame()) EXPECT_EQ(bus.send(*request), CanSendResult::sent);
    result = client.take_result();
    return result.has_value();
  });
  EXPECT_TRUE(result) << "no end of the transfer";
  return result.value_or(SdoResult{});
}

TEST_F(PythonNode, OurSdoClientTalksToIt) {
  SocketCanBus bus = running_bus({.receive = {{0x585}, {0x705}}});
  SdoClient client(5, generous);

  client.start_upload({0x1000, 0}, now());
  EXPECT_EQ(transfer(bus, client).value(), 0x00020192U);
  client.start_upload({0x1008, 0}, now());
  const SdoResult name = transfer(bus, client);
  EXPECT_EQ(std::string(name.data.begin(), name.data.end()), "CURLING DRIVE 1");
  client.start_download({{0x60FF, 0}, static_cast<std::uint32_t>(-1000), 4}, now());
  EXPECT_EQ(transfer(bus, client).outcome, SdoResult::Outcome::ok);
  client.start_upload({0x60FF, 0}, now());
  EXPECT_EQ(transfer(bus, client).value(), static_cast<std::uint32_t>(-1000));

  struct Refusal {
    SdoWrite write;
    std::uint32_t code;
  };
  for (const Refusal& refusal : {Refusal{{{0x1000, 0}, 1, 4}, 0x06010002}, Refusal{{{0x5FFF, 0}, 1, 4}, 0x06020000},
                                 Refusal{{{0x1018, 9}, 1, 4}, 0x06090011}, Refusal{{{0x6040, 0}, 6, 4}, 0x06070010},
                                 Refusal{{{0x6060, 0}, 3, 1}, 0x06090030}}) {
    client.start_download(refusal.write, now());
    const SdoResult result = transfer(bus, client);
    EXPECT_EQ(result.outcome, SdoResult::Outcome::aborted);
    EXPECT_EQ(result.abort_code, refusal.code) << result.describe();
  }
}

// Requests and answers as a third program saw them.
TEST_F(PythonNode, CandumpReadsTheGoldenTraceOfOurClientAndThisNode) {
  SocketCanBus bus = running_bus({.receive = {{0x585}}, .own = {{0x605}}});
  Process candump({"candump", "-L", "vcan0,605:7FF,585:7FF"}, "/run/golden.log");
  const auto lines = [] {
    std::ifstream file("/run/golden.log");
    std::vector<std::string> seen;
    for (const CandumpRecord& record : read_candump_log(file).records) seen.push_back(text(record.frame));
    return seen;
  };
  ASSERT_TRUE(wait_until(
      [&] {  // until it listens
        static_cast<void>(bus.send(frame("605#8000000000000405")));
        period(bus);
        return !lines().empty();
      },
      generous, 50ms));

  SdoClient client(5, generous);
  for (const SdoWrite& write : {SdoWrite{{0x6060, 0}, 9, 1}, SdoWrite{{0x6040, 0}, 6, 2},
                                SdoWrite{{0x60FF, 0}, static_cast<std::uint32_t>(-1000), 4}}) {
    client.start_download(write, now());
    EXPECT_EQ(transfer(bus, client).outcome, SdoResult::Outcome::ok);
  }
  for (const ObjectAddress address : {ObjectAddress{0x60FF, 0}, ObjectAddress{0x1008, 0}}) {
    client.start_upload(address, now());
    EXPECT_EQ(transfer(bus, client).outcome, SdoResult::Outcome::ok);
  }
  client.start_download({{0x1000, 0}, 0, 4}, now());
  EXPECT_EQ(transfer(bus, client).outcome, SdoResult::Outcome::aborted);

  const std::vector<std::string> golden{"605#2F60600009000000", "585#6060600000000000", "605#2B40600006000000",
                                        "585#6040600000000000", "605#23FF600018FCFFFF", "585#60FF600000000000",
                                        "605#40FF600000000000", "585#43FF600018FCFFFF", "605#4008100000000000",
                                        "585#410810000F000000", "605#6000000000000000", "585#004355524C494E47",
                                        "605#7000000000000000", "585#1020445249564520", "605#6000000000000000",
                                        "585#0D31000000000000", "605#2300100000000000", "585#8000100002000106"};
  std::vector<std::string> seen;
  ASSERT_TRUE(wait_until([&] {
    seen = lines();
    std::erase(seen, "605#8000000000000405");
    return seen.size() >= golden.size();
  }));
  EXPECT_EQ(seen, golden);
}

// Control periods with this set-point until `done`.
bool drive_until(SocketCanBus& bus, TwoWheelDrive& drive, const WheelSpeeds& speeds,
                 const std::function<bool()>& done) {
  return wait_until(
             [&] {
               bus.step(now());
               if (drive.state().phase == DrivePhase::enabled) drive.command(speeds, now());
               drive.step(now());
               return done() || (drive.state().error && drive.state().phase == DrivePhase::faulted);
             },
             generous, 5ms) &&
         done();
}

// The same, whatever becomes of the drive.
bool command_on(SocketCanBus& bus, TwoWheelDrive& drive, const WheelSpeeds& speeds, const std::function<bool()>& done) {
  const auto one_period = [&] {
    bus.step(now());
    drive.command(speeds, now());
    drive.step(now());
    return done();
  };
  return wait_until(one_period, generous, 5ms);
}

std::string why(const TwoWheelDrive& drive) {
  const auto error = drive.state().error;
  return error ? error->device + ": " + error->what : "no error";
}

TEST_F(PythonNode, OurDriveBootsThemDrivesThemAndStopsThem) {
  SocketCanBus bus = running_bus(robot_bus_config("vcan0"));
  TwoWheelDrive drive(bus, patient_drive_config());
  const auto phase_is = [&](DrivePhase phase) { return [&drive, phase] { return drive.state().phase == phase; }; };

  ASSERT_TRUE(drive_until(bus, drive, {}, phase_is(DrivePhase::ready))) << why(drive);
  drive.enable();
  ASSERT_TRUE(drive_until(bus, drive, {}, phase_is(DrivePhase::enabled))) << why(drive);
  ASSERT_TRUE(drive_until(bus, drive, {10.0, 5.0}, [&] {
    const WheelSpeeds measured = drive.state().measured;
    return std::abs(measured.left_radps - 10.0) < 0.01 && std::abs(measured.right_radps - 5.0) < 0.01;
  })) << why(drive);
  drive.quick_stop();
  ASSERT_TRUE(drive_until(bus, drive, {}, phase_is(DrivePhase::stopped))) << why(drive);
  EXPECT_LT(std::abs(drive.state().measured.left_radps), 0.05);
  EXPECT_EQ(bus.state().counters.foreign, 0U);
}

TEST_F(PythonNode, OurDriveWorksWithTheKernelsSync) {
  TwoWheelDriveConfig config = patient_drive_config();
  config.duties.sync = false;
  BcmCyclic sync("vcan0", sync_frame(), config.timing.control_period, now());
  ASSERT_TRUE(sync.running());
  SocketCanBus bus = running_bus(robot_bus_config("vcan0"));
  TwoWheelDrive drive(bus, config);
  const auto phase_is = [&](DrivePhase phase) { return [&drive, phase] { return drive.state().phase == phase; }; };
  ASSERT_TRUE(drive_until(bus, drive, {}, phase_is(DrivePhase::ready))) << why(drive);
  drive.enable();
  ASSERT_TRUE(drive_until(bus, drive, {}, phase_is(DrivePhase::enabled))) << why(drive);
  const auto runs = [&] { return drive.state().measured.left_radps > 9.9; };
  ASSERT_TRUE(drive_until(bus, drive, {10.0, 10.0}, runs)) << why(drive);
  drive.quick_stop();
  ASSERT_TRUE(drive_until(bus, drive, {}, phase_is(DrivePhase::stopped))) << why(drive);
}

TEST_F(PythonNode, ABusOffWhileDrivingIsAFaultAndNothingMovesWhenTheBusIsBack) {
  SocketCanBus bus = running_bus(robot_bus_config("vcan0"));
  TwoWheelDrive drive(bus, patient_drive_config());
  const auto phase_is = [&](DrivePhase phase) { return [&drive, phase] { return drive.state().phase == phase; }; };
  ASSERT_TRUE(drive_until(bus, drive, {}, phase_is(DrivePhase::ready))) << why(drive);
  drive.enable();
  ASSERT_TRUE(drive_until(bus, drive, {}, phase_is(DrivePhase::enabled))) << why(drive);
  const auto runs = [&] { return drive.state().measured.left_radps > 9.9; };
  ASSERT_TRUE(drive_until(bus, drive, {10.0, 10.0}, runs)) << why(drive);

  run("cansend vcan0 20000040#0000000000000000");
  ASSERT_TRUE(drive_until(bus, drive, {10.0, 10.0}, phase_is(DrivePhase::faulted)));
  EXPECT_EQ(drive.state().error->kind, DeviceErrorKind::disconnected) << why(drive);

  run("cansend vcan0 20000100#0000000000000000");
  ASSERT_TRUE(wait_until([&] {
    bus.step(now());
    drive.command({10.0, 10.0}, now());
    drive.step(now());
    return bus.up() && std::abs(drive.state().measured.left_radps) < 0.05;
  })) << "the wheels brake though set-points go on: "
      << drive.state().measured.left_radps;
  EXPECT_EQ(drive.state().phase, DrivePhase::faulted);
}

// What the nodes say of themselves, asked by SDO.
class Observer {
 public:
  explicit Observer(SocketCanBus& bus) : bus_(bus) {}

  std::int32_t velocity(std::uint8_t node) { return static_cast<std::int32_t>(read(node, {0x606C, 0})); }
  Cia402State state(std::uint8_t node) {
    return decode_statusword(static_cast<std::uint16_t>(read(node, {0x6041, 0})));
  }

 private:
  std::uint32_t read(std::uint8_t node, ObjectAddress address) {
    SdoClient client(node, generous);
    client.start_upload(address, now());
    std::optional<SdoResult> result;
    EXPECT_TRUE(wait_until([&] {
      for (const auto& received : period(bus_))
        if (received.frame.id == 0x580U + node) client.on_frame(received.frame, now());
      client.step(now());
      while (const auto request = client.take_frame()) static_cast<void>(bus_.send(*request));
      result = client.take_result();
      return result.has_value();
    }));
    return result ? result->value().value_or(0xFFFFFFFF) : 0xFFFFFFFF;
  }

  SocketCanBus& bus_;
};

TEST_F(PythonNode, AProgramThatIsKilledLeavesStandingWheelsWithoutPower) {
  SocketCanBus bus = running_bus();
  Process program({HOGLINE_DRIVE_PROGRAM, "vcan0"}, "/run/program.log");
  const auto says = [] {
    std::string line;
    std::ifstream file("/run/program.log");
    std::getline(file, line);
    return line;
  };
  ASSERT_TRUE(wait_until([&] { return !says().empty(); })) << "it never drove";
  ASSERT_EQ(says(), "driving");
  period(bus);

  const Stamp killed = now();
  program.signal(SIGKILL);
  program.wait();
  int cries = 0;  // EMCY 8250, RPDO timeout, of both
  ASSERT_TRUE(wait_until([&] {
    for (const auto& received : period(bus)) {
      const CanFrame& f = received.frame;
      cries += (f.id == 0x081 || f.id == 0x082) && f.data[0] == 0x50 && f.data[1] == 0x82 ? 1 : 0;
    }
    return cries == 2;
  })) << "the drives' own watchdogs over our commands";
  std::printf("killed; watchdogs after %.0f ms of 500 ms\n", seconds(now() - killed) * 1e3);

  Observer observer(bus);
  for (const std::uint8_t node : std::array<std::uint8_t, 2>{1, 2}) {
    EXPECT_TRUE(wait_until([&] { return observer.velocity(node) == 0; }));
    EXPECT_TRUE(wait_until([&] { return observer.state(node) == Cia402State::switch_on_disabled; }))
        << to_string(observer.state(node));
  }
}

// Commands that wait in the kernel while the bus takes nothing, let loose after the drives have stopped themselves.
TEST_F(PythonNode, CommandsOfAStuckBusMoveNothingWhenItComesLoose) {
  TwoWheelDriveConfig config = patient_drive_config();
  config.timing.command_age_limit = 400ms;
  config.timing.rpdo_timeout = 500ms;
  SocketCanBus bus = running_bus(robot_bus_config("vcan0"));
  TwoWheelDrive drive(bus, config);
  const auto phase_is = [&](DrivePhase phase) { return [&drive, phase] { return drive.state().phase == phase; }; };
  ASSERT_TRUE(drive_until(bus, drive, {}, phase_is(DrivePhase::ready))) << why(drive);
  drive.enable();
  ASSERT_TRUE(drive_until(bus, drive, {}, phase_is(DrivePhase::enabled))) << why(drive);
  const auto runs = [&] { return drive.state().measured.left_radps > 9.9; };
  ASSERT_TRUE(drive_until(bus, drive, {10.0, 10.0}, runs)) << why(drive);

  run("tc qdisc replace dev vcan0 root tbf rate 8bit burst 72 limit 1mb");  // four frames, then one in 16 s
  ASSERT_TRUE(drive_until(bus, drive, {10.0, 10.0}, phase_is(DrivePhase::faulted)));
  std::printf("stuck: %s\n", why(drive).c_str());
  const Stamp quiet = now() + 1500ms;  // the drives' watchdogs, and their ramps
  ASSERT_TRUE(command_on(bus, drive, {10.0, 10.0}, [&] { return now() > quiet; }));

  CanNode listener("vcan0");
  run("tc qdisc change dev vcan0 root tbf rate 10mbit burst 1mb limit 1mb");
  std::map<std::uint32_t, int> enabling;
  const Stamp end = now() + 1500ms;
  ASSERT_TRUE(command_on(bus, drive, {10.0, 10.0}, [&] {
    for (const can_frame& f : listener.hear_all()) {
      const bool rpdo = f.can_id == 0x201 || f.can_id == 0x202;
      if (rpdo && (f.data[0] & 0x0F) == 0x0F) ++enabling[f.can_id];
    }
    return now() > end;
  }));
  run("tc qdisc del dev vcan0 root");
  std::printf("old set-points that came out: %d left, %d right\n", enabling[0x201], enabling[0x202]);
  EXPECT_LE(enabling[0x201], 1);
  EXPECT_LE(enabling[0x202], 1);
  EXPECT_EQ(drive.state().phase, DrivePhase::faulted);

  SocketCanBus observing = running_bus();
  Observer observer(observing);
  for (const std::uint8_t node : std::array<std::uint8_t, 2>{1, 2}) {
    EXPECT_EQ(observer.velocity(node), 0);
    EXPECT_NE(observer.state(node), Cia402State::operation_enabled);
  }
}

TEST_F(PythonNode, ALinkThatGoesDownWhileDrivingIsAFaultAndNothingMovesWhenItIsUpAgain) {
  TwoWheelDriveConfig config = patient_drive_config();
  config.timing.rpdo_timeout = 2500ms;
  SocketCanBus bus = running_bus(robot_bus_config("vcan0"));
  TwoWheelDrive drive(bus, config);
  const auto phase_is = [&](DrivePhase phase) { return [&drive, phase] { return drive.state().phase == phase; }; };
  ASSERT_TRUE(drive_until(bus, drive, {}, phase_is(DrivePhase::ready))) << why(drive);
  drive.enable();
  ASSERT_TRUE(drive_until(bus, drive, {}, phase_is(DrivePhase::enabled))) << why(drive);
  const auto runs = [&] { return drive.state().measured.left_radps > 9.9; };
  ASSERT_TRUE(drive_until(bus, drive, {10.0, 10.0}, runs)) << why(drive);

  CanNode listener("vcan0");
  run("ip link set vcan0 down");
  ASSERT_TRUE(drive_until(bus, drive, {10.0, 10.0}, phase_is(DrivePhase::faulted)));
  EXPECT_EQ(drive.state().error->kind, DeviceErrorKind::disconnected) << why(drive);
  listener.hear_all();
  run("ip link set vcan0 up");
  int enabling = 0;
  ASSERT_TRUE(command_on(bus, drive, {10.0, 10.0},
                         [&] {
                           for (const can_frame& f : listener.hear_all()) {
                             enabling += (f.can_id == 0x201 || f.can_id == 0x202) && (f.data[0] & 0x0F) == 0x0F ? 1 : 0;
                           }
                           return bus.up() && std::abs(drive.state().measured.left_radps) < 0.05;
                         }))
      << "the wheels brake though set-points go on: " << drive.state().measured.left_radps;
  EXPECT_EQ(enabling, 0);
  EXPECT_EQ(drive.state().phase, DrivePhase::faulted);
}

}  // namespace
