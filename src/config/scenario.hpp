// The scenario file: the simulated rink, and what is wrong with the robot on it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "hw/sim/scenario.hpp"

namespace hogline::config {

/// A scenario read and checked once, from which any number of rinks are drawn.
class ScenarioFile {
 public:
  /// `name` stands in messages. Throws ConfigError.
  ScenarioFile(std::string_view text, const std::string& name);

  /// Draws what the file's ranges and choices leave open; the same seed gives the same scenario. What the rig file
  /// knows (wheel radius, track, where the stone is held) is left zero.
  hw::sim::Scenario draw(std::uint64_t seed) const;

 private:
  struct Content;
  std::shared_ptr<const Content> content_;
};

/// Reads a scenario file and draws from it once. Throws ConfigError.
hw::sim::Scenario load_scenario(const std::string& path, std::uint64_t seed);

/// The same from text; `name` stands in messages.
hw::sim::Scenario parse_scenario(std::string_view text, const std::string& name, std::uint64_t seed);

}  // namespace hogline::config
