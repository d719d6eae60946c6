#include "tests/bench/report.hpp"

#include <array>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iterator>
#include <numbers>
#include <stdexcept>
#include <thread>

namespace hogline::bench {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

std::string number(double value, int decimals) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

// Two digits that count, so that thousandths of a degree and metres go into the same column.
std::string two_digits(double value) {
  const int decimals = value >= 10.0 ? 0 : value >= 1.0 ? 1 : value >= 0.1 ? 2 : value >= 0.01 ? 3 : 4;
  return number(value, decimals);
}

std::string row(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + cell + " |";
  return line + "\n";
}

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  std::string line;
  while (std::getline(info, line)) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

std::string commit() {
  std::string text;
  const std::string command = std::string("git -C '") + HOGLINE_SOURCE_DIR + "' rev-parse --short HEAD 2>/dev/null";
  if (std::FILE* pipe = popen(command.c_str(), "r")) {
    std::array<char, 64> line{};
    if (std::fgets(line.data(), line.size(), pipe) != nullptr) text = line.data();
    pclose(pipe);
  }
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.empty() ? "unknown" : text;
}

const Column* find(const std::vector<Column>& columns, const std::string& key) {
  for (const Column& c : columns) {
    if (c.contestant.key == key) return &c;
  }
  return nullptr;
}

}  // namespace

std::string table_of(const std::vector<Column>& columns) {
  std::string text = row({"method", "median ms", "p95 ms", "without undistortion, median ms", "yaw RMS deg",
                          "yaw worst deg", "x RMS mm", "y RMS mm", "lost or refused"}) +
                     "|---|--:|--:|--:|--:|--:|--:|--:|--:|\n";
  for (const Column& column : columns) {
    const Summary s = summary_of(column);
    const bool any = s.lost < s.frames;
    const auto error = [&](double value) { return any ? two_digits(value) : std::string("-"); };
    text += row({column.contestant.name, two_digits(1e3 * s.median_s), two_digits(1e3 * s.p95_s),
                 two_digits(1e3 * s.median_without_undistortion_s), error(s.yaw_rms_rad / degree),
                 error(s.yaw_worst_rad / degree), error(1e3 * s.x_rms_m), error(1e3 * s.y_rms_m),
                 std::to_string(s.lost) + " of " + std::to_string(s.frames)});
  }
  return text;
}

std::string ratio_of(const std::vector<Column>& columns, const std::string& us, const std::string& them) {
  const Column* a = find(columns, us);
  const Column* b = find(columns, them);
  if (a == nullptr || b == nullptr) return {};
  const Summary ours = summary_of(*a);
  const Summary theirs = summary_of(*b);
  std::string text = "- " + a->contestant.name + " against " + b->contestant.name + ": " +
                     two_digits(theirs.median_s / ours.median_s) + " times faster (" +
                     two_digits(theirs.median_without_undistortion_s / ours.median_s) + " if undistorting were free)";
  if (ours.lost < ours.frames && theirs.lost < theirs.frames) {
    text += ", yaw " + two_digits(theirs.yaw_rms_rad / ours.yaw_rms_rad) + ", x " +
            two_digits(theirs.x_rms_m / ours.x_rms_m) + " times more accurate";
  }
  return text + "\n";
}

std::string where_and_when() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> date{};
  std::strftime(date.data(), date.size(), "%Y-%m-%d", &utc);
  return processor_name() + ", " + std::to_string(std::thread::hardware_concurrency()) + " cores, one used; " +
         date.data() + "; commit " + commit();
}

void put_between_markers(const std::string& path, const std::string& text) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("can not read " + path);
  std::string all((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  in.close();
  const std::string begin_mark = "<!-- bench:begin -->\n";
  const std::string end_mark = "<!-- bench:end -->";
  const std::size_t begin = all.find(begin_mark);
  const std::size_t end = all.find(end_mark);
  if (begin == std::string::npos || end == std::string::npos || end < begin) {
    throw std::runtime_error("no lines " + begin_mark + " and " + end_mark + " in " + path);
  }
  all.replace(begin + begin_mark.size(), end - begin - begin_mark.size(), text);
  std::ofstream out(path);
  out << all;
  if (!out) throw std::runtime_error("can not write " + path);
}

}  // namespace hogline::bench
