// Reading a checked section of a configuration: the schema has made sure that each key is there and in range.
#pragma once

#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "vision/percepts/stamp.hpp"

namespace hogline::config {

class Section {
 public:
  explicit Section(const nlohmann::json& object) : object_(object) {}

  Section section(const char* key) const { return Section(object_.at(key)); }
  bool has(const char* key) const { return object_.contains(key); }
  double number(const char* key) const { return object_.at(key).get<double>(); }
  int integer(const char* key) const { return object_.at(key).get<int>(); }
  bool flag(const char* key) const { return object_.at(key).get<bool>(); }
  std::string word(const char* key) const { return object_.at(key).get<std::string>(); }
  const nlohmann::json& raw(const char* key) const { return object_.at(key); }

  /// Of a key that ends in _deg, _deg_per_m, ...: degrees to radians.
  double radians(const char* key) const { return number(key) * std::numbers::pi / 180.0; }
  /// Of a key that ends in _s.
  Duration duration(const char* key) const { return from_seconds(number(key)); }

 private:
  const nlohmann::json& object_;
};

}  // namespace hogline::config
