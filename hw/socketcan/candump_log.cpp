#include "hw/socketcan/candump_log.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <istream>

namespace hogline::hw {

namespace {

constexpr std::uint32_t error_flag = 0x20000000;
constexpr std::uint32_t standard_ids = 0x7FF;
constexpr std::uint32_t extended_ids = 0x1FFFFFFF;
constexpr std::size_t longest_interface = 15;
constexpr std::size_t most_second_digits = 12;  // a year beyond 30000; microseconds still fit 64 bits

CandumpLine refuse(std::string_view reason) { return {std::nullopt, reason}; }

// Takes and removes what stands before the delimiter; nothing if the delimiter is missing.
std::optional<std::string_view> take_until(std::string_view& text, char delimiter) {
  const std::size_t end = text.find(delimiter);
  if (end == std::string_view::npos) return std::nullopt;
  const std::string_view taken = text.substr(0, end);
  text.remove_prefix(end + 1);
  return taken;
}

template <typename Number>
std::optional<Number> whole_number(std::string_view digits, int base) {
  Number value{};
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
  if (error != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
  return value;
}

bool is_interface_name(std::string_view name) {
  const bool printable = std::all_of(name.begin(), name.end(), [](char c) { return c > ' ' && c <= '~'; });
  return printable && !name.empty() && name.size() <= longest_interface;
}

std::optional<std::chrono::microseconds> decode_time(std::string_view text) {
  const auto seconds_text = take_until(text, '.');
  if (!seconds_text || seconds_text->size() > most_second_digits || text.size() != 6) return std::nullopt;
  const auto whole = whole_number<std::uint64_t>(*seconds_text, 10);
  const auto fraction = whole_number<std::uint32_t>(text, 10);
  if (!whole || !fraction) return std::nullopt;
  return std::chrono::seconds{*whole} + std::chrono::microseconds{*fraction};
}

bool decode_id(std::string_view digits, CandumpRecord& record) {
  const auto word = whole_number<std::uint32_t>(digits, 16);
  if (!word) return false;
  record.frame.extended = digits.size() == 8 && !(*word & error_flag);
  record.error_frame = digits.size() == 8 && (*word & error_flag);
  record.frame.id = record.error_frame ? *word & ~error_flag : *word;
  return (digits.size() == 3 && *word <= standard_ids) || (digits.size() == 8 && record.frame.id <= extended_ids);
}

bool decode_remote(std::string_view rest, CanFrame& frame) {
  frame.remote = true;
  if (rest.empty()) return true;
  if (rest.size() != 1 || rest[0] < '0' || rest[0] > '8') return false;
  frame.length = static_cast<std::uint8_t>(rest[0] - '0');
  return true;
}

bool decode_data(std::string_view digits, CanFrame& frame) {
  if (digits.size() % 2 != 0 || digits.size() > 16) return false;
  frame.length = static_cast<std::uint8_t>(digits.size() / 2);
  for (std::size_t i = 0; i < frame.length; ++i) {
    const auto byte = whole_number<std::uint8_t>(digits.substr(2 * i, 2), 16);
    if (!byte) return false;
    frame.data[i] = *byte;
  }
  return true;
}

std::optional<CanDirection> decode_direction(std::string_view text) {
  if (text.empty()) return CanDirection::unknown;
  if (text == "R") return CanDirection::received;
  if (text == "T") return CanDirection::transmitted;
  return std::nullopt;
}

std::string_view without_line_end(std::string_view line) {
  if (line.ends_with('\n')) line.remove_suffix(1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

}  // namespace

CandumpLine decode_candump_line(std::string_view line) {
  std::string_view rest = without_line_end(line);
  CandumpRecord record;

  if (!rest.starts_with('(')) return refuse("no time in parentheses");
  rest.remove_prefix(1);
  const auto time_text = take_until(rest, ')');
  const auto time = time_text ? decode_time(*time_text) : std::nullopt;
  if (!time) return refuse("the time is not seconds with six decimals");
  record.unix_time = *time;

  if (!rest.starts_with(' ')) return refuse("no space after the time");
  rest.remove_prefix(1);
  const auto interface = take_until(rest, ' ');
  if (!interface || !is_interface_name(*interface)) return refuse("no interface name");
  record.interface = *interface;

  const auto id = take_until(rest, '#');
  if (!id || !decode_id(*id, record)) return refuse("the identifier is not three or eight hexadecimal digits");
  if (rest.starts_with('#')) return refuse("a CAN FD frame");

  const std::size_t end_of_data = std::min(rest.find(' '), rest.size());
  const std::string_view data = rest.substr(0, end_of_data);
  const bool good = data.starts_with('R') ? !record.error_frame && decode_remote(data.substr(1), record.frame)
                                          : decode_data(data, record.frame);
  if (!good) return refuse("the data are not up to eight bytes of two hexadecimal digits");

  rest.remove_prefix(std::min(end_of_data + 1, rest.size()));
  const auto direction = decode_direction(rest);
  if (!direction) return refuse("something other than R or T after the frame");
  record.direction = *direction;
  return {std::move(record), {}};
}

std::string encode_candump_line(const CandumpRecord& record) {
  const auto whole = std::chrono::floor<std::chrono::seconds>(record.unix_time);
  const CanFrame& frame = record.frame;
  char text[80];
  const bool eight_digits = frame.extended || record.error_frame;
  std::snprintf(text, sizeof text, "(%010lld.%06lld) %.15s %0*X#", static_cast<long long>(whole.count()),
                static_cast<long long>((record.unix_time - whole).count()), record.interface.c_str(),
                eight_digits ? 8 : 3, record.error_frame ? frame.id | error_flag : frame.id);
  std::string line = text;

  if (frame.remote) {
    line += 'R';
    if (frame.length > 0) line += static_cast<char>('0' + frame.length);
  } else {
    constexpr std::string_view digits = "0123456789ABCDEF";
    for (std::size_t i = 0; i < frame.length; ++i) {
      line += digits[frame.data[i] >> 4U];
      line += digits[frame.data[i] & 15U];
    }
  }
  if (record.direction == CanDirection::received) line += " R";
  if (record.direction == CanDirection::transmitted) line += " T";
  return line;
}

CandumpLog read_candump_log(std::istream& lines) {
  CandumpLog log;
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    if (without_line_end(line).empty()) continue;
    CandumpLine decoded = decode_candump_line(line);
    if (decoded.record)
      log.records.push_back(std::move(*decoded.record));
    else
      log.refused.push_back({number, decoded.reason});
  }
  return log;
}

}  // namespace hogline::hw
