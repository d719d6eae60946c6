// The scenario file: the simulated rink, and what is wrong with the robot on it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "hw/sim/scenario.hpp"

namespace hogline::config {

/// Reads and checks a scenario file and draws what the seed varies; the same seed gives the same scenario. What the rig
/// file knows (wheel radius, track, where the stone is held) is left zero. Throws ConfigError.
hw::sim::Scenario load_scenario(const std::string& path, std::uint64_t seed);

/// The same from text; `name` stands in messages.
hw::sim::Scenario parse_scenario(std::string_view text, const std::string& name, std::uint64_t seed);

}  // namespace hogline::config
