// The DSP-3000's text and words: good ones, bad ones, and any bytes.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>

#include "hw/dsp3000/dsp3000_lines.hpp"
#include "hw/dsp3000/dsp3000_words.hpp"

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
  EXPECT_TRUE(reader.feed("5.000000 1\r\n").empty());
  const auto measurements = reader.feed("  15.000000 1\r\n");
  ASSERT_EQ(measurements.size(), 1U);
  EXPECT_NEAR(measurements[0].rate_radps, 15.0 * degree, 1e-12);
}

RC_GTEST_PROP(Dsp3000Lines, where_the_stream_is_cut_makes_no_difference, ()) {
  const std::string text = "9 1\r\n  1.000000 1\r\n  2.000000 0\r\n  3.000000 1\r\n";
  const auto cut = *rc::gen::inRange<std::size_t>(0, text.size());
  dsp3000::LineReader reader;
  auto all = reader.feed(text.substr(0, cut));
  for (const auto& more : reader.feed(text.substr(cut))) all.push_back(more);
  RC_ASSERT(all.size() == 3U);
  RC_ASSERT(std::abs(all[2].rate_radps - 3.0 * degree) < 1e-12);
  RC_ASSERT(!all[1].valid);
  RC_ASSERT(reader.garbled() == 0U);
}

RC_GTEST_PROP(Dsp3000Lines, any_bytes_give_finite_numbers_or_nothing, ()) {
  dsp3000::LineReader reader;
  for (const auto& measurement : reader.feed(*rc::gen::arbitrary<std::string>())) {
    RC_ASSERT(std::isfinite(measurement.rate_radps));
  }
}

TEST(Dsp3000Lines, noise_without_line_ends_does_not_pile_up_and_the_reader_recovers) {
  dsp3000::LineReader reader;
  EXPECT_TRUE(reader.feed(std::string(100000, 'x')).empty());
  EXPECT_TRUE(reader.feed("x 1\r\n").empty());
  EXPECT_EQ(reader.feed("1.0 1\r\n").size(), 1U);
  EXPECT_GT(reader.garbled(), 0U);
}

// Golden words, put together by hand from the maker's table of bits.
TEST(Dsp3000Words, a_word_is_read_by_its_bits) {
  const struct {
    const char* what;
    std::uint32_t word;
    double rate_degps;
    bool valid;
    dsp3000::Mode mode;
  } cases[] = {
      {"standing: valid alone is odd", 0x80000000, 0.0, true, dsp3000::Mode::rate},
      {"one step: the parity bit makes two ones odd", 0x84000001, 60e-6, true, dsp3000::Mode::rate},
      {"one step back: 26 ones and valid", 0x83FFFFFF, -60e-6, true, dsp3000::Mode::rate},
      {"ten degrees a second: 166667 = 28B0B", 0x80028B0B, 10.00002, true, dsp3000::Mode::rate},
      {"a fault of the device: not valid", 0x04000000, 0.0, false, dsp3000::Mode::rate},
      {"incremental angle", 0x8C000000, 0.0, true, dsp3000::Mode::incremental_angle},
      {"integrated angle", 0x94000000, 0.0, true, dsp3000::Mode::integrated_angle},
  };
  for (const auto& c : cases) {
    const auto measurement = dsp3000::decode_word(c.word);
    ASSERT_TRUE(measurement) << c.what;
    EXPECT_NEAR(measurement->rate_radps, c.rate_degps * degree, 1e-12) << c.what;
    EXPECT_EQ(measurement->valid, c.valid) << c.what;
    EXPECT_EQ(measurement->mode, c.mode) << c.what;
  }
}

TEST(Dsp3000Words, what_is_no_measurement_is_refused) {
  EXPECT_FALSE(dsp3000::decode_word(0x00000000)) << "even parity";
  EXPECT_FALSE(dsp3000::decode_word(0x84000000)) << "even parity";
  EXPECT_FALSE(dsp3000::decode_word(0x98000000)) << "no such type";
  EXPECT_FALSE(dsp3000::decode_word(0x81000001 | 0x04000000)) << "more than 500 deg/s, odd number of ones or not";
  EXPECT_FALSE(dsp3000::decode_word(0x81000003)) << "more than 500 deg/s";
}

std::string bytes_of(std::uint32_t word) {
  std::string bytes;
  for (unsigned shift : {24U, 16U, 8U, 0U}) bytes += static_cast<char>(word >> shift & 0xFFU);
  return bytes;
}

// A standing gyro: small rates either way, each word with its own parity.
std::string standing_words(int count) {
  std::string bytes;
  for (int i = 0; i < count; ++i) {
    std::uint32_t word = 0x80000000U | (static_cast<std::uint32_t>(i * 37 % 400 - 200) & 0x03FFFFFFU);
    if (std::popcount(word) % 2 == 0) word |= 0x04000000U;
    bytes += bytes_of(word);
  }
  return bytes;
}

TEST(Dsp3000Words, the_beginning_of_words_is_found_wherever_the_stream_starts) {
  for (std::size_t start = 0; start < 4; ++start) {
    dsp3000::WordReader reader;
    const auto all = reader.feed(standing_words(60).substr(start));
    ASSERT_GT(all.size(), 20U) << start;
    for (const auto& measurement : all) {
      EXPECT_LE(std::abs(measurement.rate_radps), 200 * 60e-6 * degree * 1.001) << start;
      EXPECT_TRUE(measurement.valid);
    }
  }
}

TEST(Dsp3000Words, a_lost_byte_is_noticed_and_the_words_are_found_again) {
  dsp3000::WordReader reader;
  reader.feed(standing_words(40));
  const auto after = reader.feed(standing_words(100).substr(1));
  EXPECT_GT(reader.garbled(), 0U);
  EXPECT_GT(after.size(), 40U);
  const auto at_last = reader.feed(standing_words(10));
  ASSERT_EQ(at_last.size(), 10U);
  for (const auto& measurement : at_last) EXPECT_LE(std::abs(measurement.rate_radps), 0.013 * degree);
}

RC_GTEST_PROP(Dsp3000Words, any_bytes_give_rates_in_range_or_nothing, ()) {
  dsp3000::WordReader reader;
  for (const auto& measurement : reader.feed(*rc::gen::arbitrary<std::string>())) {
    RC_ASSERT(std::abs(measurement.rate_radps) <= 504.0 * degree);
  }
}

}  // namespace
}  // namespace hogline::hw
