// What a throw is refused for before anything moves.
#pragma once

#include <optional>
#include <string>

#include "servo/shot.hpp"
#include "servo/thrower_config.hpp"

namespace hogline::servo {

/// Empty when the throw can be begun, else what is wrong with the configuration or the order.
std::optional<std::string> refusal(const ThrowerConfig& config, const ShotOrder& order);

/// Distance from rest to the release plane that this speed needs: the profile, and its speed held.
double needed_run_m(const ThrowerConfig& config, double speed_mps);

}  // namespace hogline::servo
