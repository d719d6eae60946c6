#include "hw/dsp3000/dsp3000_lines.hpp"

#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

namespace hogline::hw::dsp3000 {

namespace {

constexpr std::size_t longest_line = 64;  // a line has about 14 characters; more is noise on the wire

// The next token; empty at the end. Shortens `rest`.
std::string_view next_token(std::string_view& rest) {
  constexpr std::string_view blanks = " \t";
  const auto start = rest.find_first_not_of(blanks);
  if (start == std::string_view::npos) return rest = {};
  rest.remove_prefix(start);
  const auto token = rest.substr(0, rest.find_first_of(blanks));
  rest.remove_prefix(token.size());
  return token;
}

}  // namespace

std::optional<Measurement> parse_line(std::string_view line) {
  const auto number = next_token(line);
  const auto flag = next_token(line);
  if (number.empty() || !next_token(line).empty()) return std::nullopt;
  if (flag != "0" && flag != "1") return std::nullopt;
  double rate_degps = 0.0;
  const auto [end, error] =
      std::from_chars(number.data(), number.data() + number.size(), rate_degps, std::chars_format::fixed);
  if (error != std::errc{} || end != number.data() + number.size() || !std::isfinite(rate_degps)) return std::nullopt;
  return Measurement{.rate_radps = rate_degps * std::numbers::pi / 180.0, .valid = flag == "1"};
}

std::optional<Measurement> LineReader::finish_line() {
  const auto line = std::exchange(line_, {});
  if (!std::exchange(synchronised_, true)) return std::nullopt;
  if (line.empty()) return std::nullopt;  // between CR and LF
  const auto measurement = parse_line(line);
  if (!measurement) ++garbled_;
  return measurement;
}

std::vector<Measurement> LineReader::feed(std::string_view bytes) {
  std::vector<Measurement> measurements;
  for (const char byte : bytes) {
    if (byte == '\r' || byte == '\n') {
      if (const auto measurement = finish_line()) measurements.push_back(*measurement);
    } else {
      line_ += byte;
      if (line_.size() > longest_line) {
        line_.clear();
        synchronised_ = false;
        ++garbled_;
      }
    }
  }
  return measurements;
}

void LineReader::restart() {
  line_.clear();
  synchronised_ = false;
}

}  // namespace hogline::hw::dsp3000
