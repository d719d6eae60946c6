// Whole throws in closed loop: the plant knows the truth, the thrower does not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "tests/servo/rig.hpp"
#include "tests/servo/throw_harness.hpp"

namespace hogline::servo::test {
namespace {

constexpr double tee_to_hog_m = 6.401;

double lateral_error_m(const Outcome& outcome, const PlantSettings& settings, const ShotOrder& order) {
  const double along = outcome.at_release->y_m - (tee_to_hog_m - settings.hog_distance_m);
  const double right = outcome.at_release->x_m - settings.x_m;
  return -right * std::cos(order.heading_rad) - along * std::sin(order.heading_rad);
}

TEST(Throw, PlaceSpeedHeadingAndLineOverAllSpeeds) {
  double place = 0.0, mean_place = 0.0, speed = 0.0, heading = 0.0, lateral = 0.0, alignment = 0.0;
  int throws = 0;
  for (const double wanted : {1.91, 2.09, 2.32, 2.54, 2.76, 3.3}) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      ShotOrder order = draw();
      order.speed_mps = wanted;
      order.heading_rad = (seed % 2 == 0 ? 0.6 : -0.4) * degree;
      order.curl = seed % 2 == 0 ? Curl::clockwise : Curl::counter_clockwise;
      const PlantSettings settings = plain_settings(seed);
      const ThrowerConfig config = thrower_config();
      const Outcome o = throw_stone(config, order, settings);
      ASSERT_TRUE(o.finished && o.released && o.jaws_opened) << wanted << " " << seed << o.abort.value_or("");
      ASSERT_FALSE(o.abort) << *o.abort;
      const double place_error = o.at_release->hog_distance_m - config.release.hog_distance_m;
      EXPECT_LT(std::abs(place_error), 0.035);
      EXPECT_GT(o.at_release->hog_distance_m - config.release.stone_x_m, 0.145);
      EXPECT_GT(o.least_gap_m, -0.001) << "the stone was touched after its release";
      place += place_error * place_error;
      mean_place += place_error;
      speed += std::pow(o.at_release->speed_mps - wanted, 2);
      heading += std::pow(o.at_release->yaw_rad - order.heading_rad, 2);
      lateral += std::pow(lateral_error_m(o, settings, order), 2);
      alignment += std::pow(*o.yaw_after_alignment_rad - order.heading_rad, 2);
      ++throws;
    }
  }
  const auto rms = [&](double squares) { return std::sqrt(squares / throws); };
  RecordProperty("place_rms_um", static_cast<int>(1e6 * rms(place)));
  RecordProperty("place_mean_um", static_cast<int>(1e6 * mean_place / throws));
  RecordProperty("speed_rms_um_per_s", static_cast<int>(1e6 * rms(speed)));
  RecordProperty("heading_rms_mdeg", static_cast<int>(1e3 * rms(heading) / degree));
  RecordProperty("lateral_rms_um", static_cast<int>(1e6 * rms(lateral)));
  RecordProperty("alignment_rms_mdeg", static_cast<int>(1e3 * rms(alignment) / degree));
  EXPECT_LT(rms(place), 0.010);
  EXPECT_LT(std::abs(mean_place / throws), 0.004) << "no bias";
  EXPECT_LT(rms(speed), 0.006);
  EXPECT_LT(rms(heading) / degree, 0.03);
  EXPECT_LT(rms(lateral), 0.006);
  EXPECT_LT(rms(alignment) / degree, 0.03);
}

struct Turn {
  const char* description;
  double start_deg;
  double breakaway_deg_per_s;
  double gyro_bias_radps;
  double drive_lag_s;
};

class Alignment : public testing::TestWithParam<Turn> {};

TEST_P(Alignment, SettlesWithinFourSecondsWithoutOvershootOrLimitCycle) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    PlantSettings settings;
    settings.seed = seed;
    ShotOrder order = draw();
    settings.yaw_rad = order.heading_rad + GetParam().start_deg * degree;
    settings.breakaway_radps = GetParam().breakaway_deg_per_s * degree * 0.25 / 0.1;
    settings.gyro_bias_radps = GetParam().gyro_bias_radps;
    settings.drive_lag_s = GetParam().drive_lag_s;
    const Outcome o = throw_stone(thrower_config(), order, settings);
    ASSERT_FALSE(o.abort) << *o.abort;
    EXPECT_LT(o.lasted_s(ThrowerState::align), 4.0);
    const double side = std::copysign(1.0, GetParam().start_deg);
    int turns = 0;
    bool turning = false;
    for (const Moment& moment : o.moments) {
      const bool standing = moment.state == ThrowerState::align || moment.state == ThrowerState::fold;
      if (!standing) continue;
      const double error = (moment.truth.yaw_rad - order.heading_rad) / degree;
      EXPECT_GT(side * error, -0.2);
      const bool ordered = moment.command.drive.left_radps != moment.command.drive.right_radps;
      turns += ordered && !turning ? 1 : 0;
      turning = ordered;
      EXPECT_LT(std::abs(error), moment.state == ThrowerState::fold ? 0.1 : 9.0);
    }
    EXPECT_LE(turns, 4) << "no limit cycle";
  }
}

INSTANTIATE_TEST_SUITE_P(
    Turns, Alignment,
    testing::Values(Turn{"from the left", 8.0, 0.0, 0.0, 0.03}, Turn{"from the right", -8.0, 0.0, 0.0, 0.03},
                    Turn{"with stiction", 8.0, 0.5, 0.0, 0.03},
                    Turn{"with stiction from the right", -8.0, 0.5, 0.0, 0.03},
                    Turn{"with gyro bias", 8.0, 0.0, 0.008, 0.03}, Turn{"with both", -8.0, 0.5, -0.008, 0.03},
                    Turn{"slow drive", 8.0, 0.5, 0.002, 0.06}, Turn{"fast drive", -8.0, 0.5, 0.002, 0.01},
                    Turn{"a little", 0.3, 0.5, 0.002, 0.03}),
    [](const auto& param) {
      std::string name = param.param.description;
      std::replace(name.begin(), name.end(), ' ', '_');
      return name;
    });

// The near view's error may grow with the angle it looks at the sheet, and the low camera's mount may be off: neither
// spoils the heading at the release.
TEST(Throw, LastingErrorsOfTheCamerasDoNotTurnTheShot) {
  double squares = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    PlantSettings settings = plain_settings(seed);
    settings.near_yaw_gain = 1.02;
    settings.low_yaw_bias_rad = (seed % 2 == 0 ? 0.1 : -0.1) * degree;
    const Outcome o = throw_stone(thrower_config(), draw(), settings);
    ASSERT_FALSE(o.abort) << *o.abort;
    EXPECT_LT(std::abs(*o.yaw_after_alignment_rad - draw().heading_rad), 0.05 * degree);
    squares += std::pow((o.at_release->yaw_rad - draw().heading_rad) / degree, 2);
  }
  EXPECT_LT(std::sqrt(squares / 10.0), 0.03);
}

// The ramp asks for 1 m/s2. Wheels that spin are noticed, the ramp waits and goes on more gently; and where the speed
// can not be had any more the robot stops with the stone.
TEST(Throw, SlipperyIceMakesTheRampGentlerOrEndsTheThrowBeforeTheLine) {
  for (const double grip_mps2 : {0.9, 0.8, 0.7, 0.5, 0.25}) {
    PlantSettings settings = plain_settings(2);
    settings.grip_mps2 = grip_mps2;
    settings.low_hog_sigma_m = 0.004;
    settings.visible_from_m = 10.5;
    ShotOrder order = draw();
    const Outcome o = throw_stone(thrower_config(), order, settings);
    ASSERT_TRUE(o.finished) << grip_mps2;
    if (o.abort) {
      EXPECT_FALSE(o.jaws_opened) << grip_mps2;
      EXPECT_LT(grip_mps2, 0.65) << *o.abort;
      continue;
    }
    ASSERT_TRUE(o.at_release);
    EXPECT_NEAR(o.at_release->speed_mps, order.speed_mps, 0.03) << grip_mps2;
    EXPECT_NEAR(o.at_release->hog_distance_m, thrower_config().release.hog_distance_m, 0.05) << grip_mps2;
  }
}

// The paper's way: one look before the turn. What the near view gets wrong at the start angle then stays.
TEST(Throw, AlignmentByGyroAloneKeepsTheFirstLooksErrorVisualServoingDoesNot) {
  ThrowerConfig config = thrower_config();
  PlantSettings settings = plain_settings(3);
  settings.yaw_rad = draw().heading_rad + 8.0 * degree;
  settings.near_yaw_gain = 1.01;
  const auto error_deg = [&] {
    const Outcome o = throw_stone(config, draw(), settings);
    EXPECT_FALSE(o.abort) << *o.abort;
    for (const Moment& m : o.moments) {
      if (m.state == ThrowerState::fold) return (m.truth.yaw_rad - draw().heading_rad) / degree;
    }
    return 99.0;
  };
  EXPECT_LT(std::abs(error_deg()), 0.03);
  config.alignment.method = AlignmentMethod::look_then_gyro;
  EXPECT_NEAR(error_deg(), -0.084, 0.04);
  config.alignment.near_yaw_bias = {{-9.0 * degree, -0.09 * degree}, {9.0 * degree, 0.09 * degree}};
  EXPECT_LT(std::abs(error_deg()), 0.03) << "a calibrated bias is taken off";
}

TEST(Throw, GoesThroughItsStatesInOrder) {
  const Outcome o = throw_stone(thrower_config(), draw(), plain_settings(1));
  const std::vector<ThrowerState> wanted{ThrowerState::unfold, ThrowerState::measure, ThrowerState::align,
                                         ThrowerState::fold,   ThrowerState::run,     ThrowerState::release,
                                         ThrowerState::brake,  ThrowerState::stopped};
  ASSERT_EQ(o.history.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_EQ(o.history[i].state, wanted[i]) << to_string(wanted[i]);
  EXPECT_EQ(o.moments.back().command.drive.order, DriveOrder::off);
}

TEST(Throw, SpinsTheStoneInTheOrderedSense) {
  for (const Curl curl : {Curl::clockwise, Curl::counter_clockwise}) {
    ShotOrder order = draw();
    order.curl = curl;
    const Outcome o = throw_stone(thrower_config(), order, plain_settings(2));
    const double sense = curl == Curl::counter_clockwise ? 1.0 : -1.0;
    bool seen = false;
    for (const Moment& moment : o.moments) {
      if (moment.state != ThrowerState::run) continue;
      EXPECT_DOUBLE_EQ(moment.command.gripper.spin_radps, sense * order.spin_radps);
      seen = true;
    }
    EXPECT_TRUE(seen);
  }
}

TEST(Throw, KeepsToItsLimits) {
  const ThrowerConfig config = thrower_config();
  const Outcome o = throw_stone(config, draw(), plain_settings(3));
  double before = 0.0;
  for (const Moment& moment : o.moments) {
    const DriveCommand& drive = moment.command.drive;
    const double speed = (drive.left_radps + drive.right_radps) / 2.0 * config.base.wheel_radius_m;
    const bool braking = moment.state == ThrowerState::brake || moment.state == ThrowerState::stopped;
    const double bound = braking ? config.limits.max_deceleration_mps2 : config.limits.max_acceleration_mps2;
    // A fifth more, and the wheels' own units, for what is learnt of the odometry's scale.
    EXPECT_LE(std::abs(speed - before), bound * seconds(period) * 1.25);
    before = speed;
  }
}

TEST(Throw, TheSameSeedGivesTheSameBytes) {
  const Outcome a = throw_stone(thrower_config(), draw(), plain_settings(4));
  const Outcome b = throw_stone(thrower_config(), draw(), plain_settings(4));
  ASSERT_EQ(a.moments.size(), b.moments.size());
  for (std::size_t i = 0; i < a.moments.size(); ++i) {
    const DriveCommand& one = a.moments[i].command.drive;
    const DriveCommand& other = b.moments[i].command.drive;
    ASSERT_EQ(std::memcmp(&one.left_radps, &other.left_radps, sizeof(double)), 0);
    ASSERT_EQ(std::memcmp(&one.right_radps, &other.right_radps, sizeof(double)), 0);
  }
}

TEST(Throw, ToleratesALineThatIsSeenLateAndLeavesEarly) {
  PlantSettings settings = plain_settings(6);
  settings.visible_from_m = 4.5;
  settings.visible_to_m = 1.6;
  const Outcome o = throw_stone(thrower_config(), draw(), settings);
  ASSERT_FALSE(o.abort) << *o.abort;
  EXPECT_NEAR(o.at_release->hog_distance_m, thrower_config().release.hog_distance_m, 0.035);
}

}  // namespace
}  // namespace hogline::servo::test
