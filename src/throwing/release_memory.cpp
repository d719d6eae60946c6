#include "src/throwing/release_memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "src/config/config_error.hpp"
#include "src/output/output_file.hpp"

namespace hogline {
namespace {

using config::ConfigError;
using nlohmann::ordered_json;

struct Key {
  const char* name;
  double low;
  double high;
};
constexpr Key keys[] = {{"gripper_delay_s", 0.0, 0.5}, {"gripper_delay_sigma_s", 1e-6, 0.1}, {"drag_mps", -0.1, 0.1},
                        {"drag_sigma_mps", 1e-6, 0.1}, {"covariance_m", -1e-3, 1e-3},        {"throws", 0.0, 1e9}};

double number(const ordered_json& object, const Key& key, const std::string& path) {
  if (!object.contains(key.name)) throw ConfigError(path, 0, key.name, "", "missing");
  const auto& value = object.at(key.name);
  const double read = value.is_number() ? value.get<double>() : std::nan("");
  if (read >= key.low && read <= key.high) return read;
  throw ConfigError(path, 0, key.name, value.dump(), fmt::format("must be a number from {} to {}", key.low, key.high));
}

}  // namespace

std::optional<servo::ReleaseKnowledge> load_release_knowledge(const std::string& path) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  std::ifstream stream(path, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  if (!stream || std::filesystem::is_directory(path)) throw ConfigError(path, 0, "", "", "can not be read");
  const auto object = ordered_json::parse(text.str(), nullptr, false);
  if (!object.is_object()) throw ConfigError(path, 0, "", "", "is no JSON object");
  for (const auto& item : object.items()) {
    const bool known = std::ranges::any_of(keys, [&](const Key& key) { return item.key() == key.name; });
    if (!known) throw ConfigError(path, 0, item.key(), item.value().dump(), "is unknown");
  }
  double read[std::size(keys)];
  for (std::size_t i = 0; i < std::size(keys); ++i) read[i] = number(object, keys[i], path);
  if (!(std::abs(read[4]) <= read[1] * read[3])) {
    throw ConfigError(path, 0, keys[4].name, fmt::format("{}", read[4]), "is more than the sigmas allow");
  }
  return servo::ReleaseKnowledge{.delay_s = read[0],
                                 .drag_mps = read[2],
                                 .covariance = {read[1] * read[1], read[4], read[4], read[3] * read[3]},
                                 .throws = static_cast<int>(read[5])};
}

void save_release_knowledge(const std::string& path, const servo::ReleaseKnowledge& k) {
  const ordered_json object{{"gripper_delay_s", k.delay_s},    {"gripper_delay_sigma_s", std::sqrt(k.covariance[0])},
                            {"drag_mps", k.drag_mps},          {"drag_sigma_mps", std::sqrt(k.covariance[3])},
                            {"covariance_m", k.covariance[1]}, {"throws", k.throws}};
  replace_text(path, object.dump(2) + "\n");
}

}  // namespace hogline
