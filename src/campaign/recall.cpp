#include "src/campaign/recall.hpp"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>

#include "src/campaign/folder.hpp"
#include "src/config/config_error.hpp"

namespace hogline::campaign {

Recalled recall(const std::string& words) {
  const auto colon = words.rfind(':');
  std::string folder = words.substr(0, colon);
  std::size_t number = 0;
  const char* const end = words.data() + words.size();
  const char* const begin = colon == std::string::npos ? end : words.data() + colon + 1;
  const auto parsed = std::from_chars(begin, end, number);
  if (begin == end || parsed.ec != std::errc{} || parsed.ptr != end) {
    throw config::ConfigError("command line", 0, "--from", words, "must be FOLDER/throws.csv:NUMBER");
  }
  if (std::filesystem::path(folder).filename() == "throws.csv") folder = std::filesystem::path(folder).parent_path();
  if (folder.empty()) folder = ".";

  const Plan plan(read_plan(folder));
  const auto rows = read_rows(folder);
  if (number >= rows.size()) {
    throw config::ConfigError("command line", 0, "--from", words,
                              fmt::format("there are {} throws in this table, from 0", rows.size()));
  }
  const Draw draw = plan.draw(static_cast<int>(number));
  if (draw.seed != rows[number].seed) {
    throw config::ConfigError("command line", 0, "--from", words, "the row's seed is not that of this campaign");
  }
  return {plan.request(draw), draw, rows[number]};
}

}  // namespace hogline::campaign
