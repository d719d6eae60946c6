// Every fault of the gyro's line: found within its deadline, never given as valid, latched until it is re-armed.
#include <gtest/gtest.h>

#include <cctype>

#include "tests/hw/dsp3000/gyro_bench.hpp"

namespace hogline::hw {
namespace {

using enum DeviceErrorKind;

struct GyroFault {
  const char* what;
  void (*inject)(GyroBench&);
  void (*heal)(GyroBench&);
  DeviceErrorKind kind;
  Duration deadline;
  double rate_radps = 0.0;  ///< the true one meanwhile
};

constexpr Duration soon = 50ms;  // the silence limit, a reading and its latency, a step

const GyroFault gyro_faults[] = {
    {"silence", [](auto& b) { b.device.set_silent(true); }, [](auto& b) { b.device.set_silent(false); }, timeout, soon},
    {"invalid bit", [](auto& b) { b.device.set_valid(false); }, [](auto& b) { b.device.set_valid(true); }, device_fault,
     soon},
    {"garbled", [](auto& b) { b.device.set_garbled(true); }, [](auto& b) { b.device.set_garbled(false); }, protocol,
     soon},
    {"stuck", [](auto& b) { b.device.set_stuck(true); }, [](auto& b) { b.device.set_stuck(false); }, implausible,
     100ms + soon},
    {"bias step at rest", [](auto& b) { b.device.add_bias(0.08 * degree); },
     [](auto& b) { b.device.add_bias(-0.08 * degree); }, implausible, 2s + soon},
    {"overrange", [](auto&) {}, [](auto&) {}, implausible, soon, 400.0 * degree},
    {"unplugged", [](auto& b) { b.line.absent = true; }, [](auto& b) { b.line.absent = false; }, disconnected, 10ms},
    {"another mode at rest",
     [](auto& b) {
       b.device.set_deaf(true);
       b.device.set_mode(sim::GyroDevice::Mode::integrated_angle);
     },
     [](auto& b) { b.device.set_deaf(false); }, protocol, 2s + soon},
};

std::string name_of(const testing::TestParamInfo<std::tuple<GyroFault, Dsp3000Variant>>& fault) {
  std::string name = std::get<1>(fault.param) == Dsp3000Variant::text ? "text_" : "binary_";
  for (const char* c = std::get<0>(fault.param).what; *c != '\0'; ++c) name += std::isalnum(*c) != 0 ? *c : '_';
  return name;
}

class GyroLine : public testing::TestWithParam<std::tuple<GyroFault, Dsp3000Variant>> {};

TEST_P(GyroLine, fault_is_found_in_time_and_stays_until_rearmed) {
  auto [fault, variant] = GetParam();
  GyroBench bench(variant);
  // The text variant does not say its mode: an angle is told from a rate by standing still.
  if (fault.kind == protocol && fault.deadline > 1s && variant == Dsp3000Variant::text) fault.kind = implausible;
  bench.resting = false;
  bench.run(1s, 10.0 * degree);  // an integrated angle is not zero then
  bench.resting = true;
  bench.run(5s);
  ASSERT_EQ(bench.error(), "");
  ASSERT_TRUE(bench.gyro.state().valid);

  const Stamp injected = bench.now;
  fault.inject(bench);
  if (fault.rate_radps != 0.0) bench.resting = false;
  bench.run(fault.deadline, fault.rate_radps);
  const auto found = bench.gyro.state();
  ASSERT_TRUE(found.error);
  EXPECT_EQ(to_string(found.error->kind), std::string(to_string(fault.kind))) << found.error->what;
  RecordProperty("detected_after_ms", static_cast<int>(1e3 * seconds(found.error->since - injected)));
  EXPECT_TRUE(!found.valid || fault.deadline > 1s);

  fault.heal(bench);
  bench.resting = false;
  bench.run(2s);
  bench.resting = true;
  bench.run(2s);
  EXPECT_TRUE(bench.gyro.state().error) << "latched";
  bench.gyro.rearm();
  bench.run(2s);
  EXPECT_EQ(bench.error(), "");
  EXPECT_TRUE(bench.gyro.state().valid);
  EXPECT_LE(seconds(bench.now - bench.gyro.state().stamp), 0.02);
}

INSTANTIATE_TEST_SUITE_P(faults, GyroLine,
                         testing::Combine(testing::ValuesIn(gyro_faults),
                                          testing::Values(Dsp3000Variant::text, Dsp3000Variant::binary)),
                         name_of);

TEST(GyroLine, one_bad_reading_is_given_as_not_valid_and_forgiven) {
  GyroBench bench;
  bench.run(1s);
  bench.device.set_valid(false);
  bench.run(15ms);
  EXPECT_FALSE(bench.gyro.state().valid);
  bench.device.set_valid(true);
  bench.run(20ms);
  EXPECT_TRUE(bench.gyro.state().valid);
  EXPECT_EQ(bench.error(), "");
}

TEST(GyroLine, of_a_burst_after_a_stall_only_the_newest_counts) {
  GyroBench bench;
  bench.resting = false;
  bench.run(1s, 5.0 * degree);
  bench.device.set_held(true);
  bench.run(25ms, 5.0 * degree);  // shorter than the silence limit: no error yet
  bench.run(500ms, -5.0 * degree);
  EXPECT_TRUE(bench.gyro.state().error);
  EXPECT_FALSE(bench.gyro.state().valid);
  bench.device.set_held(false);
  bench.gyro.rearm();
  bench.run(600ms, -5.0 * degree);
  const auto state = bench.gyro.state();
  EXPECT_TRUE(state.valid);
  EXPECT_NEAR(state.rate_radps, -5.0 * degree, 0.1 * degree);
}

TEST(GyroLine, a_short_stall_is_no_error_and_the_newest_of_its_burst_counts) {
  auto config = gyro_config();
  config.silence_limit = 60ms;
  GyroBench bench(config, gyro_scenario());
  bench.resting = false;
  bench.run(1s, 5.0 * degree);
  bench.device.set_held(true);
  bench.run(55ms, 5.0 * degree);
  bench.device.set_held(false);
  bench.step(5.0 * degree);
  EXPECT_EQ(bench.error(), "");
  EXPECT_TRUE(bench.gyro.state().valid);
  EXPECT_NEAR(bench.gyro.state().rate_radps, 5.0 * degree, 0.1 * degree);
}

TEST(GyroLine, a_device_that_is_never_there_is_reported_with_the_reason) {
  GyroBench bench;
  bench.line.absent = true;
  bench.run(510ms);
  ASSERT_TRUE(bench.gyro.state().error);
  EXPECT_EQ(bench.gyro.state().error->kind, disconnected);
  EXPECT_EQ(bench.error(), "no such device");
}

TEST(GyroLine, a_silent_line_is_opened_anew_again_and_again) {
  GyroBench bench;
  bench.run(1s);
  bench.device.set_silent(true);
  bench.run(3s);
  EXPECT_GE(bench.line.openings, 4);
  EXPECT_LE(bench.line.openings, 16);
}

TEST(GyroLine, half_of_the_readings_lost_is_found_by_counting) {
  GyroBench bench;
  bench.run(1s);
  for (int i = 0; i < 300 && bench.error().empty(); ++i) {
    bench.device.set_garbled(i % 4 < 2);
    bench.step();
  }
  ASSERT_TRUE(bench.gyro.state().error);
  EXPECT_EQ(bench.gyro.state().error->kind, protocol);
}

}  // namespace
}  // namespace hogline::hw
