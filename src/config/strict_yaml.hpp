// YAML read without YAML's surprises: no duplicate keys, no anchors that merge, no NaN or infinity, one document.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace hogline::config {

/// A YAML file as JSON, and on which line each key stands.
struct Document {
  std::string file;                  ///< its name, for messages
  std::map<std::string, int> lines;  ///< dotted key path to line, from 1

  /// The line of a key or, where it is not in the file, of the nearest key above it; 0 if there is none.
  int line_of(const std::string& key) const;
};

/// Throws ConfigError: not readable, not YAML, a duplicate key, a number that is not finite.
nlohmann::json read_yaml(std::string_view text, Document& document);

/// The text of a file. Throws ConfigError when there is no such readable file.
std::string read_file(const std::string& path);

}  // namespace hogline::config
