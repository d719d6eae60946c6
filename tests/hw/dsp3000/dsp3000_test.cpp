// The DSP-3000's text: good lines, bad lines, and what the adapter makes of them.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "hw/dsp3000/dsp3000_gyro.hpp"

namespace hogline::hw {
namespace {

using namespace std::chrono_literals;

constexpr double degree = 3.14159265358979323846 / 180.0;

TEST(Dsp3000Lines, a_line_is_read_by_its_tokens) {
  const struct {
    const char* what;
    const char* line;
    double rate_degps;
    bool valid;
  } cases[] = {
      {"plain", "12.345678 1", 12.345678, true},
      {"negative", "-0.004178 1", -0.004178, true},
      {"padded", "     0.004178   1  ", 0.004178, true},
      {"tabs", "\t3.000000\t0", 3.0, false},
  };
  for (const auto& c : cases) {
    const auto measurement = dsp3000::parse_line(c.line);
    ASSERT_TRUE(measurement) << c.what;
    EXPECT_NEAR(measurement->rate_radps, c.rate_degps * degree, 1e-12) << c.what;
    EXPECT_EQ(measurement->valid, c.valid) << c.what;
  }
}

TEST(Dsp3000Lines, what_is_no_measurement_is_refused) {
  for (const char* line : {"", " ", "1", "12.3", "12.3 2", "12.3 1 1", "12,3 1", "nan 1", "inf 1", "1e3 1", "12.3x 1",
                           "- 1", "0x10 1", "12.3 true", "1 12.3"}) {
    EXPECT_FALSE(dsp3000::parse_line(line)) << '"' << line << '"';
  }
}

TEST(Dsp3000Lines, the_first_line_may_be_cut_and_is_thrown_away) {
  dsp3000::LineReader reader;
  EXPECT_FALSE(reader.feed("5.000000 1\r\n"));
  const auto measurement = reader.feed("  15.000000 1\r\n");
  ASSERT_TRUE(measurement);
  EXPECT_NEAR(measurement->rate_radps, 15.0 * degree, 1e-12);
}

RC_GTEST_PROP(Dsp3000Lines, where_the_stream_is_cut_makes_no_difference, ()) {
  const std::string text = "9 1\r\n  1.000000 1\r\n  2.000000 0\r\n  3.000000 1\r\n";
  const auto cut = *rc::gen::inRange<std::size_t>(0, text.size());
  dsp3000::LineReader reader;
  auto newest = reader.feed(text.substr(0, cut));
  if (const auto more = reader.feed(text.substr(cut))) newest = more;
  RC_ASSERT(newest.has_value());
  RC_ASSERT(std::abs(newest->rate_radps - 3.0 * degree) < 1e-12);
  RC_ASSERT(reader.garbled() == 0U);
}

RC_GTEST_PROP(Dsp3000Lines, any_bytes_give_finite_numbers_or_nothing, ()) {
  dsp3000::LineReader reader;
  const auto measurement = reader.feed(*rc::gen::arbitrary<std::string>());
  RC_ASSERT(!measurement || std::isfinite(measurement->rate_radps));
}

TEST(Dsp3000Lines, noise_without_line_ends_does_not_pile_up_and_the_reader_recovers) {
  dsp3000::LineReader reader;
  EXPECT_FALSE(reader.feed(std::string(100000, 'x')));
  EXPECT_FALSE(reader.feed("x 1\r\n"));
  EXPECT_TRUE(reader.feed("1.0 1\r\n"));
  EXPECT_GT(reader.garbled(), 0U);
}

class Dsp3000Adapter : public testing::Test {
 protected:
  void step(const std::string& bytes) {
    incoming = bytes;
    gyro.step(now += 10ms);
  }
  std::string incoming;
  Stamp now{};
  Dsp3000Gyro gyro{[this] { return std::exchange(incoming, {}); },
                   {.sign = -1.0, .latency = 3ms, .silence_limit = 30ms, .max_rate_radps = 375.0 * degree}};
};

TEST_F(Dsp3000Adapter, gives_the_rate_in_the_bodys_sense_at_the_moment_it_was_measured) {
  step("\r\n10.000000 1\r\n");
  EXPECT_NEAR(gyro.state().rate_radps, -10.0 * degree, 1e-12);
  EXPECT_TRUE(gyro.state().valid);
  EXPECT_EQ(gyro.state().stamp, now - 3ms);
}

TEST_F(Dsp3000Adapter, flags_faulty_and_impossible_measurements) {
  step("\r\n10.000000 0\r\n");
  EXPECT_FALSE(gyro.state().valid) << "the device's own flag";
  step("400.000000 1\r\n");
  EXPECT_FALSE(gyro.state().valid) << "beyond its range";
  step("10.000000 1\r\n");
  EXPECT_TRUE(gyro.state().valid) << "recovers";
}

TEST_F(Dsp3000Adapter, silence_is_latched_until_rearmed) {
  step("\r\n10.000000 1\r\n");
  for (int i = 0; i < 3; ++i) step("");
  EXPECT_FALSE(gyro.state().error);
  step("");
  ASSERT_TRUE(gyro.state().error);
  EXPECT_EQ(gyro.state().error->kind, DeviceErrorKind::timeout);
  EXPECT_FALSE(gyro.state().valid);
  step("10.000000 1\r\n");
  EXPECT_TRUE(gyro.state().error) << "latched";
  gyro.rearm();
  step("10.000000 1\r\n");
  EXPECT_FALSE(gyro.state().error);
  EXPECT_TRUE(gyro.state().valid);
}

TEST_F(Dsp3000Adapter, garbage_counts_as_silence) {
  step("\r\n10.000000 1\r\n");
  for (int i = 0; i < 5; ++i) step("#?!\r\n");
  EXPECT_TRUE(gyro.state().error);
}

}  // namespace
}  // namespace hogline::hw
