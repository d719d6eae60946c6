// What a scenario leaves open: ranges of numbers and choices of anything, from which a seed draws.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/config/strict_yaml.hpp"

namespace hogline::config {

/// `ranges: {section: {key: [lowest, highest]}}` stands for a number anywhere in between (uniformly), `choices:
/// {section: {key: [value, ...]}}` for one of the values; what the section itself says is the nominal value. Both are
/// in the section's own unit, and each possible value is allowed by the schema.
class ScenarioRanges {
 public:
  /// Takes both sections out of `root` and checks the rest as it stands, with every lowest, every highest and every
  /// chosen value. Throws ConfigError.
  ScenarioRanges(nlohmann::json& root, const Document& document);

  /// Puts what the seed draws into a scenario. Each key has its own sequence: another range changes no other draw.
  void draw(nlohmann::json& root, std::uint64_t seed) const;

 private:
  struct Range {
    std::string section;
    std::string key;
    double low = 0.0;
    double high = 0.0;
  };
  struct Choice {
    std::string section;
    std::string key;
    std::vector<nlohmann::json> values;
  };
  void read_ranges(const nlohmann::json& ranges, const nlohmann::json& root, const Document& document);
  void read_choices(const nlohmann::json& choices, const nlohmann::json& root, const Document& document);
  void check_ends(const nlohmann::json& root, const Document& document) const;
  void check_choices(const nlohmann::json& root, const Document& document) const;

  std::vector<Range> ranges_;
  std::vector<Choice> choices_;
};

}  // namespace hogline::config
