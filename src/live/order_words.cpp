#include "src/live/order_words.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <sstream>

namespace hogline {
namespace {

// NaN is within no limits.
bool within(double value, double least, double most) { return value >= least && value <= most; }

}  // namespace

std::optional<servo::ShotOrder> read_order(const std::string& line) {
  using Limits = OrderLimits;
  std::istringstream words(line);
  std::string verb, more;
  double speed_mps = 0.0, heading_deg = 0.0, spin_radps = 0.0;
  if (!(words >> verb >> speed_mps >> heading_deg >> spin_radps) || words >> more || verb != "order") return {};
  if (!within(speed_mps, Limits::least_speed_mps, Limits::most_speed_mps) ||
      !within(heading_deg, -Limits::most_heading_deg, Limits::most_heading_deg) ||
      !within(spin_radps, -Limits::most_spin_radps, Limits::most_spin_radps))
    return {};
  servo::ShotOrder shot;
  shot.speed_mps = speed_mps;
  shot.heading_rad = heading_deg * std::numbers::pi / 180.0;
  shot.curl = spin_radps < 0.0 ? servo::Curl::clockwise : servo::Curl::counter_clockwise;
  shot.spin_radps = std::abs(spin_radps);
  return shot;
}

std::string order_form() {
  using Limits = OrderLimits;
  return fmt::format("order SPEED_MPS HEADING_DEG SPIN_RADPS, {} to {}, {} to {}, {} to {}", Limits::least_speed_mps,
                     Limits::most_speed_mps, -Limits::most_heading_deg, Limits::most_heading_deg,
                     -Limits::most_spin_radps, Limits::most_spin_radps);
}

}  // namespace hogline
