// What a person types to order a shot.
#pragma once

#include <optional>
#include <string>

#include "servo/shot.hpp"

namespace hogline {

/// What is ordered by hand, at the most; the thrower's own limits hold besides.
struct OrderLimits {
  static constexpr double least_speed_mps = 0.5;
  static constexpr double most_speed_mps = 5.0;
  static constexpr double most_heading_deg = 8.0;  ///< to either side
  static constexpr double most_spin_radps = 6.0;   ///< to either side
};

/// "order 2.1 0.5 -1.5": m/s at release, degrees counter-clockwise from down-ice, rad/s counter-clockwise from above.
/// Empty when the line is anything else, or more than that, or a number is not within its limits.
std::optional<servo::ShotOrder> read_order(const std::string& line);

/// What is allowed.
std::string order_form();

}  // namespace hogline
