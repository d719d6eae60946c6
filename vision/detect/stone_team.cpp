#include "vision/detect/stone_team.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace hogline::vision {
namespace {

constexpr double least_saturation = 0.35;
constexpr double most_hue_error_rad = 0.44;  // 25 degrees: lamps and shade move a hue by less
constexpr double hue_sigma_rad = 0.14;

struct Hue {
  double angle_rad;
  double saturation;
};

Hue hue_of(const std::array<float, 3>& colour) {
  const double r = colour[0];
  const double g = colour[1];
  const double b = colour[2];
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

std::optional<std::array<float, 3>> handle_colour(const cv::Mat& bgr, const Eigen::Vector2d& place,
                                                  const SheetCamera& camera, const StoneShape& shape,
                                                  const IceLight& ice, const ResponseCurve& response) {
  const Bearing bearing = bearing_of(place, camera.eMc().translation());
  std::array<std::vector<float>, 3> values;
  for (int i = 0; i < 40; ++i) {
    // The near half of the plate, evenly by area; the grip stands over the far half.
    const double radius = shape.handle_radius_m * 0.85 * std::sqrt((i % 5 + 0.5) / 5.0);
    const double angle = -std::numbers::pi * (0.1 + 0.8 * (i / 5 + 0.5) / 8.0);
    const double height = shape.handle_height_m - 0.3 * shape.handle_thickness_m;
    const auto pixel = camera.project(circle_point(place, bearing, radius, height, angle));
    if (!pixel || !camera.lens().in_picture(*pixel, 1.0)) continue;
    const auto x = static_cast<int>(std::lround(pixel->x()));
    const auto y = static_cast<int>(std::lround(pixel->y()));
    const std::uint8_t* p = bgr.ptr<std::uint8_t>(y) + 3 * x;
    for (std::size_t k = 0; k < 3; ++k) values[k].push_back(response.linear(p[2 - k]));
  }
  if (values[0].size() < 20) return std::nullopt;
  const auto centre = camera.project({place.x(), place.y(), shape.handle_height_m});
  if (!centre) return std::nullopt;
  const auto white = ice.at(centre->x(), centre->y());
  std::array<float, 3> colour{};
  for (std::size_t k = 0; k < 3; ++k) {
    auto& v = values[k];
    const auto middle = v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2);
    std::nth_element(v.begin(), middle, v.end());
    colour[k] = *middle / white[2 - k];
  }
  return colour;
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
  return {first < second ? Team::first : Team::second, std::max(a, b) / (a + b + outsider)};
}

}  // namespace hogline::vision
