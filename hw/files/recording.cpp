#include "hw/files/recording.hpp"

#include <algorithm>
#include <cassert>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>

namespace hogline::hw::files {
namespace {

namespace fs = std::filesystem;

constexpr double longest_s = 1e8;  // three years: nanoseconds hold it

bool digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

// Digits at `at` without leading zeros.
std::string_view number_at(std::string_view text, std::size_t& at) {
  while (at < text.size() && text[at] == '0') ++at;
  const std::size_t begin = at;
  while (at < text.size() && digit(text[at])) ++at;
  return text.substr(begin, at - begin);
}

bool before(std::string_view a, std::string_view b) {
  std::size_t i = 0;
  std::size_t k = 0;
  while (i < a.size() && k < b.size()) {
    if (digit(a[i]) && digit(b[k])) {
      const auto m = number_at(a, i);
      const auto n = number_at(b, k);
      if (m.size() != n.size()) return m.size() < n.size();
      if (m != n) return m < n;
    } else {
      if (a[i] != b[k]) return a[i] < b[k];
      ++i;
      ++k;
    }
  }
  if (a.size() - i != b.size() - k) return a.size() - i < b.size() - k;
  return a < b;  // 1.png and 01.png
}

bool is_picture(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".jpg" || extension == ".jpeg" || extension == ".png";
}

template <typename T>
std::optional<T> parsed(std::string_view text) {
  T value{};
  const auto r = std::from_chars(text.data(), text.data() + text.size(), value);
  return r.ec == std::errc{} && r.ptr == text.data() + text.size() ? std::optional<T>(value) : std::nullopt;
}

std::optional<RecordedFrame> parse_line(std::string_view line, const fs::path& folder) {
  const auto last = line.rfind(',');
  const auto first = last == std::string_view::npos ? last : line.rfind(',', last - 1);
  if (first == std::string_view::npos || first == 0 || first == last) return std::nullopt;
  const auto id = parsed<std::uint64_t>(line.substr(first + 1, last - first - 1));
  const auto time_s = parsed<double>(line.substr(last + 1));
  if (!id || !time_s || !std::isfinite(*time_s) || *time_s < 0.0 || *time_s > longest_s) return std::nullopt;
  return RecordedFrame{(folder / line.substr(0, first)).string(), *id, from_seconds(*time_s)};
}

}  // namespace

Recording read_folder(const std::string& folder, double rate_hz) {
  assert(rate_hz > 0.0);
  std::error_code code;
  std::vector<std::string> names;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
    if (is_picture(entry->path())) names.push_back(entry->path().filename().string());
  }
  if (code) return {{}, folder + ": can not be read as a folder: " + code.message()};
  if (names.empty()) return {{}, folder + ": holds no JPEG or PNG file"};
  std::sort(names.begin(), names.end(), before);

  Recording recording;
  for (std::size_t k = 0; k < names.size(); ++k) {
    recording.frames.push_back(
        {(fs::path(folder) / names[k]).string(), k, from_seconds(static_cast<double>(k) / rate_hz)});
  }
  return recording;
}

Recording read_stamps_file(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  if (!file || !std::getline(file, line)) return {{}, path + ": can not be read"};
  if (line.ends_with('\r')) line.pop_back();
  if (line != "name,id,time_s") return {{}, path + ":1: must be name,id,time_s"};

  Recording recording;
  for (int number = 2; std::getline(file, line); ++number) {
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty()) continue;
    const std::string place = path + ":" + std::to_string(number) + ": ";
    const auto frame = parse_line(line, fs::path(path).parent_path());
    if (!frame) return {{}, place + "must be a file's name, a whole number and a time in seconds, parted by commas"};
    const auto& frames = recording.frames;
    if (!frames.empty() && (frame->id <= frames.back().id || frame->time <= frames.back().time)) {
      return {{}, place + "number and time must be above those of the line before"};
    }
    recording.frames.push_back(*frame);
  }
  if (recording.frames.empty()) return {{}, path + ": lists no picture"};
  return recording;
}

}  // namespace hogline::hw::files
