// The head against simulated drives: profile moves by the handshake, tracking, limits, directions, and its faults.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/hw/can_text.hpp"
#include "tests/hw/canopen/head_bench.hpp"

namespace hogline::hw::test {
namespace {

constexpr double tolerance_rad = 0.04 * degree;

TEST(TwoAxisHead, BootsWithItsLimitsAndProfileInTheDrivesOwnUnits) {
  HeadBench bench;
  ASSERT_TRUE(bench.run_until(DrivePhase::ready, 3s)) << bench.head.state().error.value_or(DeviceError{}).what;
  const sim::ObjectDictionary& pan = bench.pan.communication().objects();
  const sim::ObjectDictionary& tilt = bench.tilt.communication().objects();
  const double counts_per_degree = head_gear_ratio * 4096.0 / 360.0;
  EXPECT_NEAR(pan.get_signed(0x607D, 1), 1000 - 170.0 * counts_per_degree, 1.0);
  EXPECT_NEAR(pan.get_signed(0x607D, 2), 1000 + 170.0 * counts_per_degree, 1.0);
  // The tilt drive turns the other way: what is up for it is down for the head.
  EXPECT_NEAR(tilt.get_signed(0x607D, 1), -20000 - 75.0 * counts_per_degree, 1.0);
  EXPECT_NEAR(tilt.get_signed(0x607D, 2), -20000 + 20.0 * counts_per_degree, 1.0);
  EXPECT_NEAR(pan.get(0x6081), 2.0 / degree * counts_per_degree, 1.0);
  EXPECT_NEAR(pan.get(0x6083), 6.0 / degree * counts_per_degree, 1.0);
  EXPECT_EQ(pan.get(0x6083), pan.get(0x6084));
  EXPECT_EQ(pan.get(0x6067), 23u);  // 0.02 degrees
  EXPECT_EQ(pan.get(0x1016, 1), (127u << 16) | 150u);
  EXPECT_EQ(pan.get(0x1400, 5), 40u);
  EXPECT_EQ(pan.get(0x6007), 3u);
  EXPECT_EQ(pan.get(0x605A), 2u);
  EXPECT_EQ(pan.get(0x605E), 2u);
  EXPECT_EQ(pan.get_signed(0x6061), 1);
}

TEST(TwoAxisHead, PointsWhereItIsToldWhateverWayItsMotorsAreMounted) {
  HeadBench bench;
  ASSERT_TRUE(bench.get_enabled());
  const auto arrived = bench.point(40.0 * degree, 25.0 * degree);
  ASSERT_TRUE(arrived) << bench.head.state().error.value_or(DeviceError{}).what;
  EXPECT_NEAR(bench.pan_rad(), 40.0 * degree, tolerance_rad);
  EXPECT_NEAR(bench.tilt_rad(), 25.0 * degree, tolerance_rad);
  const HeadState state = bench.head.state();
  EXPECT_NEAR(state.measured.pan_rad, bench.pan_rad(), 0.01 * degree);
  EXPECT_NEAR(state.measured.tilt_rad, bench.tilt_rad(), 0.01 * degree);
  EXPECT_LE(bench.now() - state.stamp, 10ms);
  EXPECT_EQ(state.phase, DrivePhase::enabled);
  bench.run(1s);
  EXPECT_NEAR(bench.pan_rad(), 40.0 * degree, tolerance_rad) << "and stays";
}

TEST(TwoAxisHead, TheHandshakeOnTheBusIsThatOfTheStandard) {
  HeadBench bench;
  ASSERT_TRUE(bench.get_enabled());
  std::vector<std::string>
      changes;  // of RPDO1 (controlword), RPDO2 and TPDO1 (statusword bits 10, 12) of the pan drive
  std::string last_control, last_target, last_status;
  bench.on_frame = [&](const StampedCanFrame& seen) {
    const auto note = [&changes](std::string& last, const std::string& news) {
      if (news != last) changes.push_back(news);
      last = news;
    };
    if (seen.frame.id == 0x203) note(last_control, text(seen.frame).substr(0, 8));
    if (seen.frame.id == 0x303) note(last_target, text(seen.frame));
    if (seen.frame.id == 0x183) {
      const int bits = seen.frame.data[1] & 0x14;
      note(last_status,
           std::string("status ") + (bits & 0x10 ? "acknowledged" : "free") + (bits & 4 ? " reached" : ""));
    }
  };
  bench.run(20ms);
  changes.clear();
  ASSERT_TRUE(bench.point(10.0 * degree, 0.0));
  const std::vector<std::string> expected{"303#5A30000001",       // 607A = 1000 + 11378 counts, 6060 = 1
                                          "203#3F00",             // then bits 4 and 5
                                          "status acknowledged",  // bit 12; bit 10 is gone
                                          "203#0F00",             // bit 4 down
                                          "status free",          // bit 12 down: ready for the next
                                          "status free reached"};
  EXPECT_EQ(changes, expected);
}

TEST(TwoAxisHead, ANewerTargetReplacesAnOlderOneInFlight) {
  HeadBench bench;
  ASSERT_TRUE(bench.get_enabled());
  bench.head.point({90.0 * degree, 0.0}, bench.now());
  bench.run(400ms);
  ASSERT_GT(bench.speed_radps(), 0.5);
  double farthest = 0.0;
  bench.head.point({-30.0 * degree, 10.0 * degree}, bench.now());
  ASSERT_TRUE(bench.run_until(
      [&] {
        farthest = std::max(farthest, bench.pan_rad());
        return bench.head.state().on_target;
      },
      5s));
  EXPECT_LT(farthest, 60.0 * degree) << "turned round at once";
  EXPECT_NEAR(bench.pan_rad(), -30.0 * degree, tolerance_rad);
}

TEST(TwoAxisHead, KeepsItsSpeedAndRamp) {
  HeadBench bench;
  ASSERT_TRUE(bench.get_enabled());
  bench.head.point({150.0 * degree, 0.0}, bench.now());
  double fastest = 0.0;
  const auto arrived = bench.run_until(
      [&] {
        fastest = std::max(fastest, bench.speed_radps());
        return bench.head.state().on_target;
      },
      5s);
  ASSERT_TRUE(arrived);
  EXPECT_NEAR(fastest, 2.0, 0.02);
  // 150 degrees at 2 rad/s with two ramps of 1/3 s, and the last degrees by the drive's position loop.
  EXPECT_NEAR(seconds(*arrived), 150.0 * degree / 2.0 + 2.0 / 6.0, 0.45);
}

TEST(TwoAxisHead, TracksWithARateAndStandsWhenNoNewOneComes) {
  HeadBench bench;
  ASSERT_TRUE(bench.get_enabled());
  bench.rates = PanTiltRate{0.5, -0.1};
  bench.run(1s);
  EXPECT_NEAR(bench.motor_radps[0] / head_gear_ratio, 0.5, 0.005);
  EXPECT_NEAR(bench.motor_radps[1] / head_gear_ratio, 0.1, 0.005) << "mounted the other way round";
  EXPECT_NEAR(bench.head.state().rate.pan_radps, 0.5, 0.05);
  EXPECT_NEAR(bench.head.state().rate.tilt_radps, -0.1, 0.05);
  EXPECT_GT(bench.pan_rad(), 0.4);

  bench.rates.reset();
  const auto stands = bench.run_until([&bench] { return bench.standing(); }, 1s);
  ASSERT_TRUE(stands);
  EXPECT_LE(*stands, 90ms) << "15 ms of command age and the drive's lag";
  bench.run(1s);
  EXPECT_EQ(bench.head.state().phase, DrivePhase::enabled);
}

TEST(TwoAxisHead, GoesFromTrackingToAPointAndBack) {
  HeadBench bench;
  ASSERT_TRUE(bench.get_enabled());
  for (int i = 0; i < 3; ++i) {
    bench.rates = PanTiltRate{0.6, 0.2};
    bench.run(300ms);
    ASSERT_EQ(bench.head.state().phase, DrivePhase::enabled) << bench.head.state().error.value_or(DeviceError{}).what;
    bench.rates.reset();
    ASSERT_TRUE(bench.point(-20.0 * degree * i, 5.0 * degree)) << bench.head.state().error.value_or(DeviceError{}).what;
    EXPECT_NEAR(bench.pan_rad(), -20.0 * degree * i, tolerance_rad);
  }
}

TEST(TwoAxisHead, TrackingEndsAtTheLimitWithoutAJolt) {
  HeadBench bench;
  ASSERT_TRUE(bench.get_enabled());
  bench.rates = PanTiltRate{0.0, 1.5};
  double lowest = 0.0;
  for (int i = 0; i < 3000; ++i) {
    bench.run(1ms);
    lowest = std::max(lowest, bench.tilt_rad());
  }
  EXPECT_LE(lowest, 75.0 * degree + 0.1 * degree);
  EXPECT_NEAR(bench.tilt_rad(), 75.0 * degree, 0.5 * degree);
  EXPECT_EQ(bench.head.state().phase, DrivePhase::enabled) << bench.head.state().error.value_or(DeviceError{}).what;
  bench.rates = PanTiltRate{0.0, -1.0};
  bench.run(500ms);
  EXPECT_LT(bench.tilt_rad(), 60.0 * degree) << "and the way back is free";
}

TEST(TwoAxisHead, StopsOnItsRampAndTakesThePowerAway) {
  HeadBench bench;
  ASSERT_TRUE(bench.get_enabled());
  bench.rates = PanTiltRate{2.0, 0.0};
  bench.run(700ms);
  bench.head.stop();
  const auto stopped = bench.run_until(DrivePhase::stopped, 2s);
  ASSERT_TRUE(stopped);
  EXPECT_NEAR(seconds(*stopped), 2.0 / 12.0, 0.1);
  EXPECT_FALSE(bench.pan.operation_enabled());
  bench.run(300ms);
  EXPECT_TRUE(bench.standing()) << "though the caller goes on";
  bench.rates.reset();
  bench.head.enable();
  ASSERT_TRUE(bench.run_until(DrivePhase::enabled, 1s));
  bench.run(500ms);
  EXPECT_TRUE(bench.standing()) << "no target from before the stop comes back";
}

struct BadTarget {
  const char* description;
  PanTilt target;
};

TEST(TwoAxisHead, AnglesThatAreNotFiniteOrBeyondTheLimitsAreAFault) {
  for (const BadTarget& row : {BadTarget{"not a number", {std::nan(""), 0.0}},
                               BadTarget{"infinite", {0.0, std::numeric_limits<double>::infinity()}},
                               BadTarget{"beyond the pan limit", {171.0 * degree, 0.0}},
                               BadTarget{"below the tilt limit", {0.0, -21.0 * degree}}}) {
    HeadBench bench;
    ASSERT_TRUE(bench.get_enabled());
    bench.head.point({60.0 * degree, 0.0}, bench.now());
    bench.run(300ms);
    bench.head.point(row.target, bench.now());
    ASSERT_TRUE(bench.run_until(DrivePhase::faulted, 10ms)) << row.description;
    EXPECT_EQ(bench.head.state().error->kind, DeviceErrorKind::implausible) << row.description;
    EXPECT_TRUE(bench.run_until([&bench] { return bench.standing(); }, 1s)) << row.description;
  }
}

TEST(TwoAxisHead, ARateThatIsTooFastIsAFault) {
  HeadBench bench;
  ASSERT_TRUE(bench.get_enabled());
  bench.head.track({2.1, 0.0}, bench.now());
  EXPECT_TRUE(bench.run_until(DrivePhase::faulted, 10ms));
}

struct HeadFault {
  const char* description;
  std::function<void(HeadBench&)> inject;
  Duration deadline;
  DeviceErrorKind kind;
  const char* what;
};

void PrintTo(const HeadFault& fault, std::ostream* out) { *out << fault.description; }

class TwoAxisHeadFault : public testing::TestWithParam<HeadFault> {};

TEST_P(TwoAxisHeadFault, IsDetectedInTimeStopsTheHeadAndNothingMovesUntilRearmed) {
  HeadBench bench;
  ASSERT_TRUE(bench.get_enabled());
  bench.head.point({100.0 * degree, 30.0 * degree}, bench.now());
  bench.run(350ms);
  ASSERT_GT(bench.speed_radps(), 1.0);
  GetParam().inject(bench);
  const auto detected = bench.run_until(DrivePhase::faulted, 5s);
  ASSERT_TRUE(detected);
  EXPECT_LE(*detected, GetParam().deadline);
  const DeviceError error = bench.head.state().error.value();
  EXPECT_EQ(error.kind, GetParam().kind) << error.what;
  EXPECT_NE(error.what.find(GetParam().what), std::string::npos) << error.what;
  ASSERT_TRUE(bench.run_until([&bench] { return bench.standing(); }, 1s));

  bench.pan.faults = {};
  bench.pan.communication().faults = {};
  bench.bus.set_up(true);
  const double where = bench.pan_rad();
  bench.head.enable();  // refused
  for (int i = 0; i < 200; ++i) {
    bench.head.point({0.0, 0.0}, bench.now());  // the caller goes on
    bench.run(5ms);
  }
  EXPECT_NEAR(bench.pan_rad(), where, 0.01 * degree);
  EXPECT_EQ(bench.head.state().phase, DrivePhase::faulted);

  bench.rates.reset();
  bench.head.rearm();
  ASSERT_TRUE(bench.run_until(DrivePhase::ready, 3s)) << bench.head.state().error.value_or(DeviceError{}).what;
  bench.run(200ms);
  EXPECT_NEAR(bench.pan_rad(), where, 0.01 * degree);
  ASSERT_TRUE(bench.get_enabled());
  EXPECT_TRUE(bench.point(0.0, 0.0));
}

INSTANTIATE_TEST_SUITE_P(
    Table, TwoAxisHeadFault,
    testing::Values(HeadFault{"a new target is never acknowledged",
                              [](HeadBench& b) {
                                b.pan.faults.set_point_ignored = true;
                                b.head.point({0.0, 0.0}, b.now());
                              },
                              515ms, DeviceErrorKind::refused, "does not acknowledge"},
                    HeadFault{"the acknowledgement is stuck",
                              [](HeadBench& b) {
                                b.pan.faults.acknowledge_stuck = true;
                                b.head.point({0.0, 0.0}, b.now());
                              },
                              515ms, DeviceErrorKind::refused, "bit 12"},
                    HeadFault{"target reached is claimed at once",
                              [](HeadBench& b) { b.pan.faults.reached_at_once = true; }, 15ms,
                              DeviceErrorKind::implausible, "has not reached"},
                    HeadFault{"the axis is blocked",
                              [](HeadBench& b) {
                                b.pan.communication().objects().set(0x6081, 0, 0);  // demands nothing
                              },
                              3500ms, DeviceErrorKind::timeout, "does not reach"},
                    HeadFault{"a change of mode is not confirmed",
                              [](HeadBench& b) {
                                b.pan.faults.mode_never_confirmed = true;
                                b.rates = PanTiltRate{};
                              },
                              515ms, DeviceErrorKind::device_fault, "does not confirm mode 9"},
                    HeadFault{"the encoder jumps", [](HeadBench& b) { b.pan.axis().slip_encoder(1.0); }, 15ms,
                              DeviceErrorKind::implausible, "encoder"},
                    HeadFault{"fault of the drive", [](HeadBench& b) { b.pan.raise_fault(0x8611); }, 15ms,
                              DeviceErrorKind::device_fault, "8611"},
                    HeadFault{"the heartbeat stops",
                              [](HeadBench& b) { b.pan.communication().faults.heartbeat_stopped = true; }, 160ms,
                              DeviceErrorKind::timeout, "heartbeat"},
                    HeadFault{"the bus goes away", [](HeadBench& b) { b.bus.set_up(false); }, 10ms,
                              DeviceErrorKind::disconnected, "bus off"}),
    [](const auto& instance) {
      std::string name;
      for (const char* c = instance.param.description; *c; ++c) name += std::isalnum(*c) ? *c : '_';
      return name;
    });

TEST(TwoAxisHead, WhenTheProgramDiesTheDrivesStopByThemselves) {
  HeadBench bench;
  ASSERT_TRUE(bench.get_enabled());
  bench.head.point({150.0 * degree, 0.0}, bench.now());
  bench.run(500ms);
  bench.loop_stalled = true;
  const auto stands = bench.run_until([&bench] { return bench.standing(); }, 2s);
  ASSERT_TRUE(stands);
  EXPECT_LE(*stands, 40ms + 170ms + 60ms);
}

struct BadHeadConfig {
  std::function<void(TwoAxisHeadConfig&)> spoil;
  const char* message;
};

TEST(HeadConfig, BadOnesNameKeyValueAndWhatIsAllowed) {
  EXPECT_EQ(config_error(head_config()).value_or(""), "");
  EXPECT_TRUE(config_error(TwoAxisHeadConfig{}));
  const BadHeadConfig rows[] = {
      {[](auto& c) { c.pan.identity.node = 128; }, "pan.node is 128"},
      {[](auto& c) { c.tilt.identity.node = 3; }, "must differ"},
      {[](auto& c) { c.tilt.gearing.direction = 2; }, "tilt.direction is 2"},
      {[](auto& c) { c.pan.min_rad = unset; }, "pan.min_rad is nan"},
      {[](auto& c) { c.pan.max_rad = -4.0; }, "less than max_rad"},
      {[](auto& c) { c.tilt.min_rad = 0.1; }, "angle 0 lies within"},
      {[](auto& c) { c.pan.zero_counts = 2147400000; }, "limits in counts"},
      {[](auto& c) { c.tilt.tolerance_rad = 1e-9; }, "tolerance_rad in counts"},
      {[](auto& c) { c.pan.acceleration_radps2 = unset; }, "acceleration_radps2 is nan"},
      {[](auto& c) { c.timing.rpdo_timeout = 10ms; }, "rpdo_timeout"},
  };
  for (const BadHeadConfig& row : rows) {
    TwoAxisHeadConfig config = head_config();
    row.spoil(config);
    const std::string error = config_error(config).value_or("");
    EXPECT_NE(error.find(row.message), std::string::npos) << "'" << error << "' should say '" << row.message << "'";
  }
  SteppedClock clock;
  sim::VirtualCanBus bus(clock);
  EXPECT_THROW(TwoAxisHead(bus.make_endpoint(), TwoAxisHeadConfig{}), std::invalid_argument);
}

}  // namespace
}  // namespace hogline::hw::test
