#include "src/config/scenario_ranges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hw/sim/mixed_bits.hpp"
#include "src/config/config_error.hpp"
#include "src/config/schema.hpp"

namespace hogline::config {
namespace {

using nlohmann::json;

constexpr const char* schema = "scenario.schema.json";

json take(json& root, const char* key) {
  if (!root.is_object() || !root.contains(key)) return json::object();
  json part = root[key];
  root.erase(key);
  return part;
}

[[noreturn]] void refuse(const Document& document, const std::string& key, const json& value,
                         const std::string& problem) {
  std::string text = value.dump();
  if (text.size() > 40) text = text.substr(0, 37) + "...";
  throw ConfigError(document.file, document.line_of(key), key, text, problem);
}

// Calls back for each SECTION.KEY that the scenario knows; of those that it does not know the schema's check tells.
template <typename Use>
void each_entry(const std::string& name, const json& part, const json& root, const Document& document, Use use) {
  if (!part.is_object()) refuse(document, name, part, "must be sections with keys");
  for (const auto& [section, keys] : part.items()) {
    const std::string path = name + "." + section;
    if (!root.contains(section)) refuse(document, path, keys, "there is no such section");
    if (!keys.is_object()) refuse(document, path, keys, "must be keys with values");
    for (const auto& [key, value] : keys.items()) {
      if (!root[section].contains(key))
        refuse(document, path + "." + key, value, "section " + section + " has no such key");
      use(section, key, value, path + "." + key);
    }
  }
}

// The schema speaks of SECTION.KEY; the mistake stands in `name`.
void check_as(const json& root, const Document& document, const std::string& name) {
  try {
    check(root, schema, document);
  } catch (const ConfigError& e) {
    const std::string key = name + "." + e.key;
    throw ConfigError(e.file, document.line_of(key), key, e.value, e.allowed);
  }
}

// FNV-1a: the same on every machine.
std::uint64_t hash_of(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return hash;
}

double unit_of(std::uint64_t seed, const std::string& section, const std::string& key) {
  using hw::sim::mixed_bits;
  return hw::sim::uniform_of(mixed_bits(mixed_bits(seed) ^ hash_of(section + "." + key)));
}

}  // namespace

ScenarioRanges::ScenarioRanges(json& root, const Document& document) {
  const json ranges = take(root, "ranges");
  const json choices = take(root, "choices");
  check(root, schema, document);
  read_ranges(ranges, root, document);
  read_choices(choices, root, document);
  check_ends(root, document);
  check_choices(root, document);
}

void ScenarioRanges::read_ranges(const json& ranges, const json& root, const Document& document) {
  each_entry("ranges", ranges, root, document,
             [&](const std::string& section, const std::string& key, const json& value, const std::string& path) {
               const auto number = [](const json& v) { return v.is_number(); };
               const json& nominal = root[section][key];
               if (!nominal.is_number())
                 refuse(document, path, value, "is no number; what is no number goes to choices");
               if (!value.is_array() || value.size() != 2 || !std::ranges::all_of(value, number)) {
                 refuse(document, path, value, "must be [lowest, highest]");
               }
               const Range range{section, key, value[0].get<double>(), value[1].get<double>()};
               const auto own = nominal.get<double>();
               if (!(range.low <= own && own <= range.high)) {
                 refuse(document, path, value, fmt::format("must hold the section's own value, {}", own));
               }
               ranges_.push_back(range);
             });
}

void ScenarioRanges::read_choices(const json& choices, const json& root, const Document& document) {
  each_entry("choices", choices, root, document,
             [&](const std::string& section, const std::string& key, const json& value, const std::string& path) {
               if (!value.is_array() || value.empty()) refuse(document, path, value, "must be a list of values");
               const auto same = [&](const Range& r) { return r.section == section && r.key == key; };
               if (std::ranges::any_of(ranges_, same)) refuse(document, path, value, "has a range already");
               choices_.push_back({section, key, {value.begin(), value.end()}});
             });
}

void ScenarioRanges::check_ends(const json& root, const Document& document) const {
  constexpr double between = 0.6180339887;  // no whole number where whole numbers are asked for
  for (const double share : {0.0, 1.0, between}) {
    json drawn = root;
    for (const Range& r : ranges_) {
      if (r.low < r.high || share == 0.0) drawn[r.section][r.key] = r.low + share * (r.high - r.low);
    }
    check_as(drawn, document, "ranges");
  }
}

void ScenarioRanges::check_choices(const json& root, const Document& document) const {
  for (const Choice& c : choices_) {
    for (const json& value : c.values) {
      json chosen = root;
      chosen[c.section][c.key] = value;
      check_as(chosen, document, "choices");
    }
  }
}

void ScenarioRanges::draw(json& root, std::uint64_t seed) const {
  for (const Range& r : ranges_) root[r.section][r.key] = r.low + (r.high - r.low) * unit_of(seed, r.section, r.key);
  for (const Choice& c : choices_) {
    const auto count = static_cast<double>(c.values.size());
    root[c.section][c.key] = c.values[static_cast<std::size_t>(unit_of(seed, c.section, c.key) * count)];
  }
}

}  // namespace hogline::config
