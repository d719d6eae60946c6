#include "src/config/config_error.hpp"

#include <fmt/format.h>

namespace hogline::config {
namespace {

std::string message(const std::string& file, int line, const std::string& key, const std::string& value,
                    const std::string& problem) {
  std::string text = line > 0 ? fmt::format("{}:{}: ", file, line) : fmt::format("{}: ", file);
  if (!key.empty()) text += value.empty() ? fmt::format("{}: ", key) : fmt::format("{} = {}: ", key, value);
  return text + problem;
}

}  // namespace

ConfigError::ConfigError(std::string file_name, int line_number, std::string key_path, std::string value_text,
                         std::string problem)
    : std::runtime_error(message(file_name, line_number, key_path, value_text, problem)),
      file(std::move(file_name)),
      line(line_number),
      key(std::move(key_path)),
      value(std::move(value_text)),
      allowed(std::move(problem)) {}

}  // namespace hogline::config
