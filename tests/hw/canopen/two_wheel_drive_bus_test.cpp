// The bus goes away and comes back, loses, doubles and corrupts frames.
#include <gtest/gtest.h>

#include "tests/hw/can_text.hpp"
#include "tests/hw/canopen/drive_bench.hpp"

namespace hogline::hw::test {
namespace {

/// Counts RPDOs that would make a wheel move: enable operation with a target other than 0.
struct MotionCounter {
  int frames = 0;
  void operator()(const StampedCanFrame& seen) {
    const CanFrame& frame = seen.frame;
    if ((frame.id != 0x201 && frame.id != 0x202) || frame.length != 6) return;
    const bool enables = frame.data[0] == 0x0F;
    const bool target = (frame.data[2] | frame.data[3] | frame.data[4] | frame.data[5]) != 0;
    frames += enables && target ? 1 : 0;
  }
};

TEST(TwoWheelDriveBus, NoStaleCommandReachesADriveAfterBusOff) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(10.0));
  bench.bus.set_up(false);
  const auto detected = bench.run_until(DrivePhase::faulted, 100ms);
  ASSERT_TRUE(detected);
  EXPECT_LE(*detected, 5ms);
  EXPECT_EQ(bench.drive.state().error->kind, DeviceErrorKind::disconnected);

  MotionCounter motion;
  bench.on_frame = std::ref(motion);
  bench.set_point = WheelSpeeds{10.0, 10.0};  // the caller knows nothing
  bench.run(100ms);
  bench.bus.set_up(true);
  bench.run(3s);
  EXPECT_EQ(motion.frames, 0);
  EXPECT_TRUE(bench.standing());
  EXPECT_EQ(bench.drive.state().phase, DrivePhase::faulted);
}

TEST(TwoWheelDriveBus, WithTheBusGoneTheDrivesBrakeByThemselves) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(20.0));
  bench.bus.set_up(false);
  ASSERT_TRUE(bench.run_until([&bench] { return bench.standing(); }, 1s));
  EXPECT_LT(bench.fastest_radps, 20.1);
}

TEST(TwoWheelDriveBus, OnlyOurAdapterUnplugged) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(20.0));
  bench.bus.set_endpoint_up(bench.master, false);
  ASSERT_TRUE(bench.run_until(DrivePhase::faulted, 10ms));
  ASSERT_TRUE(bench.run_until([&bench] { return bench.standing(); }, 1s));
  bench.bus.set_endpoint_up(bench.master, true);
  bench.run(3s);
  bench.drive.rearm();
  ASSERT_TRUE(bench.run_until(DrivePhase::ready, 3s));
}

TEST(TwoWheelDriveBus, ABusWentDownWhileBootingLeavesNoOldBootFramesBehind) {
  DriveBench bench;
  bench.run(60ms);
  bench.bus.set_up(false);
  bench.run(1s);
  bench.bus.set_up(true);
  std::string nmt;
  bench.on_frame = [&nmt](const StampedCanFrame& seen) {
    if (seen.frame.id == 0x000) nmt += text(seen.frame) + " ";
  };
  bench.run(500ms);
  EXPECT_EQ(nmt, "");
  bench.drive.rearm();
  EXPECT_TRUE(bench.run_until(DrivePhase::ready, 3s));
}

TEST(TwoWheelDriveBus, NoRoomForCommandsIsAFault) {
  DriveBench bench(drive_config(), {.bit_rate_hz = 1e6});
  ASSERT_TRUE(bench.get_running(10.0));
  // A babbling node with the highest priority takes the whole bus.
  const auto babble = [&bench] {
    while (bench.stray.send({.id = 0x001, .length = 8, .data = {}}) == CanSendResult::sent) continue;
  };
  const auto detected = bench.run_until(
      [&] {
        babble();
        return bench.drive.state().phase == DrivePhase::faulted;
      },
      1s);
  ASSERT_TRUE(detected);
  EXPECT_LE(*detected, 160ms);
  const auto stood = bench.run_until(
      [&] {
        babble();
        return bench.standing();
      },
      2s);
  EXPECT_TRUE(stood) << "the drives' own watchdogs";
}

TEST(TwoWheelDriveBus, LostSyncIsFoundByTheFeedback) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(10.0));
  bench.bus.set_filter([](const CanFrame& frame) { return frame.id != 0x080; });
  const auto detected = bench.run_until(DrivePhase::faulted, 1s);
  ASSERT_TRUE(detected);
  EXPECT_LE(*detected, 35ms);
}

TEST(TwoWheelDriveBus, OurHeartbeatLostAloneStopsTheDrives) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(10.0));
  bench.bus.set_filter([](const CanFrame& frame) { return frame.id != 0x77F; });
  const auto detected = bench.run_until(DrivePhase::faulted, 1s);
  ASSERT_TRUE(detected);
  EXPECT_LE(*detected, 160ms);
  EXPECT_NE(bench.drive.state().error->what.find("8130"), std::string::npos) << bench.drive.state().error->what;
  ASSERT_TRUE(bench.run_until([&bench] { return bench.standing(); }, 1s));
}

// The kernel's timer sends SYNC; our program is held up between looking at the clock and reading the bus.
TEST(TwoWheelDriveBus, FramesReadAllAtOnceByAProgramThatWasHeldUpAreNotTakenForASecondNode) {
  TwoWheelDriveConfig config = drive_config();
  config.duties.sync = false;
  config.timing.rpdo_timeout = 200ms;
  DriveBench bench(config);
  bench.on_tick = [&bench] {
    if ((bench.now() - Stamp{}) % 5ms == 0ms) bench.stray.send({.id = 0x080, .data = {}});
  };
  ASSERT_TRUE(bench.get_running(10.0));
  const Stamp looked_at_the_clock = bench.now() + 5ms;
  bench.loop_stalled = true;
  bench.run(45ms);  // nine answers to SYNC wait to be read
  bench.drive.command({10.0, 10.0}, looked_at_the_clock);
  bench.drive.step(looked_at_the_clock);
  EXPECT_FALSE(bench.drive.state().error) << bench.drive.state().error->what;
}

TEST(TwoWheelDriveBus, ALostOrDoubledFrameNowAndThenIsSurvived) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(10.0));
  bench.bus.set_faults(0.01, 0.01, 0.0);
  bench.run(5s);
  EXPECT_EQ(bench.drive.state().phase, DrivePhase::enabled) << bench.drive.state().error.value_or(DeviceError{}).what;
  EXPECT_GT(bench.bus.frames_lost(), 30u);
  EXPECT_NEAR(bench.wheel_radps(0), 10.0, 0.05);
}

TEST(TwoWheelDriveBus, AReorderedFrameNowAndThenIsSurvived) {
  DriveBench bench(drive_config(), {.bit_rate_hz = 1e6});
  ASSERT_TRUE(bench.get_running(10.0));
  bench.bus.set_reordering(0.05);
  for (int i = 0; i < 5000; ++i) {
    bench.tick();
    bench.set_point = WheelSpeeds{10.0 + 5.0 * std::sin(i * 1e-3), 10.0 + 5.0 * std::sin(i * 1e-3)};
  }
  EXPECT_EQ(bench.drive.state().phase, DrivePhase::enabled) << bench.drive.state().error.value_or(DeviceError{}).what;
  EXPECT_NEAR(bench.wheel_radps(0), 10.0 + 5.0 * std::sin(5.0), 0.2);
}

TEST(TwoWheelDriveBus, FeedbackThatComesLateAndAllAtOnceIsSurvived) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(10.0));
  // An adapter that hands its frames over every 20 ms: 4 at a time.
  std::vector<CanFrame> held;
  bench.bus.set_filter([&held, open = false, &bench](const CanFrame& frame) mutable {
    open = (bench.now() - Stamp{}) % 20ms == 0ms;
    const bool feedback = frame.id == 0x181 || frame.id == 0x281;
    if (feedback && !open) held.push_back(frame);
    return !feedback || open;
  });
  bench.on_tick = [&] {
    if ((bench.now() - Stamp{}) % 20ms != 0ms) return;
    for (const CanFrame& frame : held) bench.stray.send(frame);
    held.clear();
  };
  bench.run(2s);
  const DeviceError error = bench.drive.state().error.value_or(DeviceError{});
  EXPECT_EQ(error.what.find("sends twice"), std::string::npos) << error.what;
}

TEST(TwoWheelDriveBus, ASyncThatIsLateByTwoPeriodsIsSurvived) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(10.0));
  bench.bus.set_filter([n = 0](const CanFrame& frame) mutable { return frame.id != 0x080 || ++n % 50 > 2; });
  bench.run(3s);
  EXPECT_EQ(bench.drive.state().phase, DrivePhase::enabled) << bench.drive.state().error.value_or(DeviceError{}).what;
}

// What a bus that takes nothing does with commands: they wait, and come out when it is free.
TEST(TwoWheelDriveBus, OldCommandsOfAStuckBusDoNotEnableADriveThatStoppedItself) {
  for (const Duration stuck : {60ms, 100ms, 149ms, 300ms, 2000ms}) {
    DriveBench bench(drive_config(), {.bit_rate_hz = 1e6});
    ASSERT_TRUE(bench.get_running(20.0));
    bench.bus.set_stuck(true);
    bench.run(stuck);
    ASSERT_FALSE(bench.left.operation_enabled()) << "its RPDO watchdog";
    bench.bus.set_stuck(false);
    MotionCounter motion;
    bench.on_frame = std::ref(motion);
    double before = bench.wheel_radps(0);
    for (int i = 0; i < 3000; ++i) {
      bench.tick();
      ASSERT_FALSE(bench.left.operation_enabled()) << stuck / 1ms << " ms stuck, " << i << " ms later";
      ASSERT_LE(bench.wheel_radps(0), before + 0.01);
      before = bench.wheel_radps(0);
    }
    EXPECT_TRUE(bench.standing());
    EXPECT_EQ(bench.drive.state().phase, DrivePhase::faulted);
    // Each wheel's commands until the fault, 15 ms after the first set-point that could not leave.
    EXPECT_GT(motion.frames, 0) << "else nothing was tested";
  }
}

TEST(TwoWheelDriveBus, CorruptedFramesEndInAStop) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    DriveBench bench(drive_config(), {.seed = seed});
    ASSERT_TRUE(bench.get_running(10.0));
    bench.bus.set_faults(0.0, 0.0, 0.05);
    ASSERT_TRUE(bench.run_until(DrivePhase::faulted, 10s)) << "seed " << seed;
    bench.bus.set_faults(0.0, 0.0, 0.0);
    EXPECT_TRUE(bench.run_until([&bench] { return bench.standing(); }, 3s)) << "seed " << seed;
    bench.fastest_radps = 0.0;
    bench.run(1s);
    EXPECT_LT(bench.fastest_radps, 0.2) << "seed " << seed;
    EXPECT_EQ(bench.drive.state().phase, DrivePhase::faulted);
  }
}

TEST(TwoWheelDriveBus, ForeignFramesWithOurIdentifiersAreIgnored) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(10.0));
  bench.stray.send({.id = 0x181, .extended = true, .length = 8, .data = {}});
  bench.stray.send({.id = 0x181, .remote = true, .length = 7, .data = {}});
  bench.stray.send({.id = 0x703, .length = 1, .data = {0x00}});
  bench.stray.send({.id = 0x083, .length = 8, .data = {0x10, 0x23}});
  bench.run(100ms);
  EXPECT_EQ(bench.drive.state().phase, DrivePhase::enabled);
}

TEST(TwoWheelDriveBus, TheSameSeedGivesTheSameBytes) {
  const auto run = [](std::uint64_t seed) {
    DriveBench bench(drive_config(), {.bit_rate_hz = 1e6, .loss = 0.0, .seed = seed});
    EXPECT_TRUE(bench.get_running(10.0));
    bench.bus.set_faults(0.005, 0.005, 0.0);
    bench.run(1s);
    return bench.log;
  };
  const std::string first = run(7);
  EXPECT_EQ(first, run(7));
  EXPECT_NE(first, run(8));
}

TEST(TwoWheelDriveBus, TheBusLoadStaysWithinTheMap) {
  DriveBench bench(drive_config(), {.bit_rate_hz = 1e6});
  ASSERT_TRUE(bench.get_running(10.0));
  int frames = 0;
  bench.on_frame = [&frames](const StampedCanFrame&) { ++frames; };
  bench.run(1s);
  // 200 of each: SYNC, two RPDOs, four TPDOs; 20 of each of three heartbeats.
  EXPECT_NEAR(frames, 200 * 7 + 3 * 20, 10);
}

}  // namespace
}  // namespace hogline::hw::test
