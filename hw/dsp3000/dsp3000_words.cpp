#include "hw/dsp3000/dsp3000_words.hpp"

#include <bit>
#include <numbers>

namespace hogline::hw::dsp3000 {

namespace {

constexpr double rate_step_radps = 60e-6 * std::numbers::pi / 180.0;
constexpr unsigned content_bits = 26;
constexpr int believed_after = 8;
constexpr int given_up_after = 4;

std::int32_t content_of(std::uint32_t word) {
  constexpr unsigned unused = 32 - content_bits;
  return static_cast<std::int32_t>(word << unused) >> unused;
}

// 375 deg/s is 23 bits with their sign; more is no rate, or no beginning of a word.
bool fits(std::int32_t content) { return content >= -(1 << 23) && content < (1 << 23); }

}  // namespace

std::optional<Measurement> decode_word(std::uint32_t word) {
  if (std::popcount(word) % 2 == 0) return std::nullopt;
  const unsigned type = word >> 27U & 0x03U;
  if (type > 2) return std::nullopt;
  const std::int32_t content = content_of(word);
  if (type == 0 && !fits(content)) return std::nullopt;
  return Measurement{.rate_radps = type == 0 ? rate_step_radps * content : 0.0,
                     .valid = (word >> 31U) != 0,
                     .mode = static_cast<Mode>(type)};
}

std::vector<Measurement> WordReader::feed(std::string_view bytes) {
  std::vector<Measurement> measurements;
  for (const char byte : bytes) {
    newest_ = newest_ << 8U | static_cast<unsigned char>(byte);
    ++bytes_;
    if (bytes_ < 4) continue;
    if (!place_) {
      look_for_words();
    } else if (bytes_ % 4 == *place_) {
      if (const auto measurement = take(newest_)) measurements.push_back(*measurement);
    }
  }
  return measurements;
}

void WordReader::look_for_words() {
  const auto place = static_cast<unsigned>(bytes_ % 4);
  const auto word = decode_word(newest_);
  const bool good = word && word->valid;
  if (!good || word->mode != mode_[place]) good_in_a_row_[place] = 0;
  if (good) {
    mode_[place] = word->mode;
    ++good_in_a_row_[place];
  }
  if (good_in_a_row_[place] < believed_after) return;
  place_ = place;
  bad_in_a_row_ = 0;
}

std::optional<Measurement> WordReader::take(std::uint32_t word) {
  const auto measurement = decode_word(word);
  if (measurement) {
    bad_in_a_row_ = 0;
    return measurement;
  }
  ++garbled_;
  if (++bad_in_a_row_ >= given_up_after) restart();
  return std::nullopt;
}

void WordReader::restart() {
  place_.reset();
  good_in_a_row_ = {};
  bytes_ = 0;
}

}  // namespace hogline::hw::dsp3000
