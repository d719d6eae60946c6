// Our drive adapter drives foreign nodes over the kernel's bus, and what becomes of them when bus or program fail.
#include <csignal>
#include <fstream>
#include <map>

#include "hw/canopen/nmt.hpp"
#include "hw/socketcan/bcm_cyclic.hpp"
#include "tests/hil/can_node.hpp"
#include "tests/hil/foreign_wheels.hpp"
#include "tests/hil/python_node.hpp"

using namespace hogline;
using namespace hogline::hw;
using namespace hogline::hil;

namespace {

constexpr WheelSpeeds ahead{10.0, 10.0};
constexpr std::array<std::uint8_t, 2> wheel_nodes{1, 2};

// Commands that would let a wheel turn, node by node.
std::map<std::uint32_t, int> enabling_commands(CanNode& listener) {
  std::map<std::uint32_t, int> count;
  for (const can_frame& f : listener.hear_all()) {
    const bool rpdo = f.can_id == 0x201 || f.can_id == 0x202;
    if (rpdo && (f.data[0] & 0x0F) == 0x0F) ++count[f.can_id];
  }
  return count;
}

TEST_F(PythonNode, OurDriveBootsThemDrivesThemAndStopsThem) {
  ForeignWheels wheels;
  ASSERT_TRUE(wheels.run_at({10.0, 5.0}));
  wheels.drive.quick_stop();
  ASSERT_TRUE(wheels.drive_until(DrivePhase::stopped)) << wheels.why();
  EXPECT_TRUE(wheels.left_stands());
  EXPECT_EQ(wheels.bus.state().counters.foreign, 0U);
}

TEST_F(PythonNode, OurDriveWorksWithTheKernelsSync) {
  TwoWheelDriveConfig config = patient_drive_config();
  config.duties.sync = false;
  BcmCyclic sync("vcan0", sync_frame(), config.timing.control_period, now());
  ASSERT_TRUE(sync.running());
  ForeignWheels wheels(config);
  ASSERT_TRUE(wheels.run_at(ahead));
  wheels.drive.quick_stop();
  ASSERT_TRUE(wheels.drive_until(DrivePhase::stopped)) << wheels.why();
}

TEST_F(PythonNode, ABusOffWhileDrivingIsAFaultAndNothingMovesWhenTheBusIsBack) {
  ForeignWheels wheels;
  ASSERT_TRUE(wheels.run_at(ahead));

  run("cansend vcan0 20000040#0000000000000000");
  ASSERT_TRUE(wheels.drive_until(DrivePhase::faulted, ahead));
  EXPECT_EQ(wheels.drive.state().error->kind, DeviceErrorKind::disconnected) << wheels.why();

  run("cansend vcan0 20000100#0000000000000000");
  ASSERT_TRUE(wheels.command_until(ahead, [&] { return wheels.bus.up() && wheels.left_stands(); }))
      << "the wheels brake though set-points go on";
  EXPECT_EQ(wheels.drive.state().phase, DrivePhase::faulted);
}

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
  for (const std::uint8_t node : wheel_nodes) {
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
  ForeignWheels wheels(config);
  ASSERT_TRUE(wheels.run_at(ahead));

  run("tc qdisc replace dev vcan0 root tbf rate 8bit burst 72 limit 1mb");  // four frames, then one in 16 s
  ASSERT_TRUE(wheels.drive_until(DrivePhase::faulted, ahead));
  std::printf("stuck: %s\n", wheels.why().c_str());
  const Stamp quiet = now() + 1500ms;  // the drives' watchdogs, and their ramps
  ASSERT_TRUE(wheels.command_until(ahead, [&] { return now() > quiet; }));

  CanNode listener("vcan0");
  run("tc qdisc change dev vcan0 root tbf rate 10mbit burst 1mb limit 1mb");
  std::map<std::uint32_t, int> came_out;
  const Stamp end = now() + 1500ms;
  ASSERT_TRUE(wheels.command_until(ahead, [&] {
    for (const auto& [id, count] : enabling_commands(listener)) came_out[id] += count;
    return now() > end;
  }));
  run("tc qdisc del dev vcan0 root");
  std::printf("old set-points that came out: %d left, %d right\n", came_out[0x201], came_out[0x202]);
  EXPECT_LE(came_out[0x201], 1);
  EXPECT_LE(came_out[0x202], 1);
  EXPECT_EQ(wheels.drive.state().phase, DrivePhase::faulted);

  SocketCanBus observing = running_bus();
  Observer observer(observing);
  for (const std::uint8_t node : wheel_nodes) {
    EXPECT_EQ(observer.velocity(node), 0);
    EXPECT_NE(observer.state(node), Cia402State::operation_enabled);
  }
}

TEST_F(PythonNode, ALinkThatGoesDownWhileDrivingIsAFaultAndNothingMovesWhenItIsUpAgain) {
  TwoWheelDriveConfig config = patient_drive_config();
  config.timing.rpdo_timeout = 2500ms;
  ForeignWheels wheels(config);
  ASSERT_TRUE(wheels.run_at(ahead));

  CanNode listener("vcan0");
  run("ip link set vcan0 down");
  ASSERT_TRUE(wheels.drive_until(DrivePhase::faulted, ahead));
  EXPECT_EQ(wheels.drive.state().error->kind, DeviceErrorKind::disconnected) << wheels.why();
  listener.hear_all();
  run("ip link set vcan0 up");
  int enabling = 0;
  ASSERT_TRUE(wheels.command_until(ahead, [&] {
    for (const auto& [id, count] : enabling_commands(listener)) enabling += count;
    return wheels.bus.up() && wheels.left_stands();
  })) << "the wheels brake though set-points go on";
  EXPECT_EQ(enabling, 0);
  EXPECT_EQ(wheels.drive.state().phase, DrivePhase::faulted);
}

}  // namespace
