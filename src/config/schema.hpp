// Checks a configuration against one of the JSON schemas of config/, and says what is wrong in a person's words.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "src/config/strict_yaml.hpp"

namespace hogline::config {

/// Throws ConfigError for the first thing wrong: an unknown key (with the nearest known one), a missing key, a value of
/// the wrong type or outside its range. `schema_name` is an embedded file, e.g. "rig.schema.json".
void check(const nlohmann::json& value, std::string_view schema_name, const Document& document);

}  // namespace hogline::config
