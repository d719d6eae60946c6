#include "vision/detect/stone_team.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vision/geometry/pose.hpp"

namespace hogline::vision {
namespace {

constexpr double least_saturation = 0.35;
constexpr double most_hue_error_rad = 0.44;  // 25 degrees: lamps and shade move a hue by less
constexpr double hue_sigma_rad = 0.14;
constexpr double least_confidence = 0.8;  // less is a guess

struct Hue {
  double angle_rad;
  double saturation;
};

Hue hue_of(const std::array<float, 3>& colour) {
  const double r{colour[0]};
  const double g{colour[1]};
  const double b{colour[2]};
  const double high = std::max({r, g, b});
  const double low = std::min({r, g, b});
  // The hexagon's angle, which is what hue means to people who choose one.
  const double spread = high - low;
  if (!(spread > 0.0)) return {0.0, 0.0};
  double sixth = 0.0;
  if (high == r) {
    sixth = (g - b) / spread;
  } else if (high == g) {
    sixth = 2.0 + (b - r) / spread;
  } else {
    sixth = 4.0 + (r - g) / spread;
  }
  return {wrapped(sixth * std::numbers::pi / 3.0), spread / high};
}

}  // namespace

bool has_a_teams_hue(const std::array<float, 3>& colour, const TeamHues& hues) {
  const Hue hue = hue_of(colour);
  if (hue.saturation < least_saturation) return false;
  return std::min(std::abs(wrapped(hue.angle_rad - hues.first_rad)),
                  std::abs(wrapped(hue.angle_rad - hues.second_rad))) < most_hue_error_rad;
}

TeamVerdict team_of(const std::array<float, 3>& colour, const TeamHues& hues) {
  const Hue hue = hue_of(colour);
  if (hue.saturation < least_saturation) return {Team::unknown, 1.0 - hue.saturation / least_saturation};
  const double first = std::abs(wrapped(hue.angle_rad - hues.first_rad));
  const double second = std::abs(wrapped(hue.angle_rad - hues.second_rad));
  const double nearest = std::min(first, second);
  if (nearest > most_hue_error_rad) return {Team::unknown, std::min(1.0, nearest / most_hue_error_rad - 1.0)};
  const auto likelihood = [](double error) { return std::exp(-0.5 * error * error / (hue_sigma_rad * hue_sigma_rad)); };
  const double a = likelihood(first);
  const double b = likelihood(second);
  const double outsider = likelihood(most_hue_error_rad);
  const double confidence = std::max(a, b) / (a + b + outsider);
  if (confidence < least_confidence) return {Team::unknown, 1.0 - confidence};
  return {first < second ? Team::first : Team::second, confidence};
}

}  // namespace hogline::vision
