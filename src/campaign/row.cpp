#include "src/campaign/row.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <variant>
#include <vector>

namespace hogline::campaign {
namespace {

constexpr double degrees = 180.0 / std::numbers::pi;

using Field = std::variant<int Row::*, std::uint64_t Row::*, double Row::*, bool Row::*, std::optional<double> Row::*,
                           std::string Row::*>;
struct Column {
  const char* name;
  Field field;
};

const std::vector<Column>& columns() {
  static const std::vector<Column> table{{"throw", &Row::number},
                                         {"seed", &Row::seed},
                                         {"speed_mps", &Row::speed_mps},
                                         {"heading_deg", &Row::heading_deg},
                                         {"spin_radps", &Row::spin_radps},
                                         {"ok", &Row::ok},
                                         {"released", &Row::released},
                                         {"hog_line_violation", &Row::hog_line_violation},
                                         {"stone_burned", &Row::stone_burned},
                                         {"place_error_mm", &Row::place_error_mm},
                                         {"speed_error_mmps", &Row::speed_error_mmps},
                                         {"heading_error_deg", &Row::heading_error_deg},
                                         {"lateral_error_mm", &Row::lateral_error_mm},
                                         {"spin_error_percent", &Row::spin_error_percent},
                                         {"yaw_after_alignment_deg", &Row::yaw_after_alignment_deg},
                                         {"delay_believed_ms", &Row::delay_believed_ms},
                                         {"delay_measured_ms", &Row::delay_measured_ms},
                                         {"alignment_s", &Row::alignment_s},
                                         {"rest_x_m", &Row::rest_x_m},
                                         {"rest_y_m", &Row::rest_y_m},
                                         {"stop_hog_distance_m", &Row::stop_hog_distance_m},
                                         {"simulated_s", &Row::simulated_s},
                                         {"abort", &Row::abort}};
  return table;
}

// CSV (RFC 4180), but a row never spans lines.
std::string quoted(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

std::string word_of(bool value) { return value ? "1" : "0"; }
std::string word_of(int value) { return std::to_string(value); }
std::string word_of(std::uint64_t value) { return std::to_string(value); }
std::string word_of(double value) { return fmt::format("{}", value); }
std::string word_of(const std::optional<double>& value) { return value ? word_of(*value) : ""; }
std::string word_of(const std::string& value) { return quoted(value); }

template <typename Number>
bool read_number(const std::string& word, Number& value) {
  const auto parsed = std::from_chars(word.data(), word.data() + word.size(), value);
  return !word.empty() && parsed.ec == std::errc{} && parsed.ptr == word.data() + word.size();
}
bool read(const std::string& word, int& value) { return read_number(word, value); }
bool read(const std::string& word, std::uint64_t& value) { return read_number(word, value); }
bool read(const std::string& word, double& value) { return read_number(word, value) && std::isfinite(value); }
bool read(const std::string& word, bool& value) {
  value = word == "1";
  return word == "0" || word == "1";
}
bool read(const std::string& word, std::optional<double>& value) {
  if (word.empty()) return true;
  return read(word, value.emplace());
}
bool read(const std::string& word, std::string& value) {
  value = word;
  return true;
}

std::optional<std::vector<std::string>> words_of(std::string_view line) {
  std::vector<std::string> words(1);
  bool inside = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (inside && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      words.back() += '"';
      ++i;
    } else if (c == '"') {
      inside = !inside;
    } else if (c == ',' && !inside) {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  if (inside) return std::nullopt;
  return words;
}

// From the first moment of a state to that of the next.
std::optional<double> length_of(const ThrowResult& result, const std::string& state) {
  for (std::size_t i = 0; i + 1 < result.states.size(); ++i) {
    if (result.states[i].name == state) return result.states[i + 1].t_s - result.states[i].t_s;
  }
  return std::nullopt;
}

}  // namespace

Row row_of(const Draw& draw, const ThrowResult& result) {
  const double sense = draw.order.curl == servo::Curl::counter_clockwise ? 1.0 : -1.0;
  Row row{.number = draw.number,
          .seed = draw.seed,
          .speed_mps = draw.order.speed_mps,
          .heading_deg = draw.order.heading_rad * degrees,
          .spin_radps = sense * draw.order.spin_radps,
          .ok = result.ok,
          .released = result.release.has_value(),
          .hog_line_violation = result.hog_line_violation,
          .stone_burned = result.stone_burned,
          .place_error_mm = {},
          .speed_error_mmps = {},
          .heading_error_deg = {},
          .lateral_error_mm = {},
          .spin_error_percent = {},
          .yaw_after_alignment_deg = {},
          .delay_believed_ms = {},
          .delay_measured_ms = {},
          .alignment_s = length_of(result, "align"),
          .rest_x_m = {},
          .rest_y_m = {},
          .stop_hog_distance_m = result.stop_hog_distance_m,
          .simulated_s = result.sim_time_s,
          .abort = result.abort.value_or("")};
  if (result.yaw_after_alignment_rad) row.yaw_after_alignment_deg = *result.yaw_after_alignment_rad * degrees;
  if (result.believed_delay_s) row.delay_believed_ms = 1e3 * *result.believed_delay_s;
  if (result.measured_delay_s) row.delay_measured_ms = 1e3 * *result.measured_delay_s;
  if (const auto& release = result.release) {
    row.place_error_mm = 1e3 * (release->hog_distance_m - release->target_hog_distance_m);
    row.speed_error_mmps = 1e3 * release->speed_error_mps;
    row.heading_error_deg = release->heading_error_rad * degrees;
    row.lateral_error_mm = 1e3 * release->lateral_error_m;
    if (draw.order.spin_radps > 0.0) row.spin_error_percent = 100.0 * release->spin_error_radps / draw.order.spin_radps;
  }
  if (result.rest) {
    row.rest_x_m = result.rest->x_m;
    row.rest_y_m = result.rest->y_m;
  }
  return row;
}

std::string header() {
  std::string text;
  for (const Column& c : columns()) text += (text.empty() ? "" : ",") + std::string(c.name);
  return text;
}

std::string line_of(const Row& row) {
  std::string text;
  for (const Column& c : columns()) {
    if (&c != &columns().front()) text += ',';
    text += std::visit([&](auto field) { return word_of(row.*field); }, c.field);
  }
  return text;
}

std::optional<Row> parse_row(std::string_view line) {
  const auto words = words_of(line);
  if (!words || words->size() != columns().size()) return std::nullopt;
  Row row;
  for (std::size_t i = 0; i < words->size(); ++i) {
    const auto take = [&](auto field) { return read((*words)[i], row.*field); };
    if (!std::visit(take, columns()[i].field)) return std::nullopt;
  }
  return row;
}

}  // namespace hogline::campaign
