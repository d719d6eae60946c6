// Small pictures of one blurred edge or bar at a known place, for tests.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "vision/edges/profile.hpp"

namespace hogline::vision::testing {

/// The edge passes `offset_px` from the picture's middle along its normal, which is turned by angle_deg from x.
struct DrawnEdge {
  double angle_deg = 0.0;
  double offset_px = 0.0;
  double width_px = 0.0;  ///< of a bar; 0 for a step
  double blur_px = 1.0;   ///< standard deviation
  double gamma = 1.0;
  double noise = 0.0;  ///< standard deviation of linear light
  unsigned seed = 1;
  std::array<double, 3> before{0.8, 0.8, 0.8};  ///< linear light, B G R
  std::array<double, 3> paint{0.2, 0.2, 0.2};
};

struct DrawnPicture {
  static constexpr int size_px = 96;
  static constexpr double middle_px = 47.5;
  std::vector<std::uint8_t> pixels;
  Eigen::Vector2d normal;

  Picture picture() const { return {pixels.data(), size_px, size_px, 3, 3U * size_px}; }
  Eigen::Vector2d centre() const { return {middle_px, middle_px}; }
};

inline DrawnPicture draw(const DrawnEdge& edge) {
  DrawnPicture drawn;
  const double angle = edge.angle_deg * std::numbers::pi / 180.0;
  drawn.normal = {std::cos(angle), std::sin(angle)};
  drawn.pixels.resize(3U * DrawnPicture::size_px * DrawnPicture::size_px);
  std::mt19937 generator(edge.seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  const auto share = [&edge](double t) { return 0.5 * std::erfc(-t / (edge.blur_px * std::numbers::sqrt2)); };
  std::size_t k = 0;
  for (int y = 0; y < DrawnPicture::size_px; ++y) {
    for (int x = 0; x < DrawnPicture::size_px; ++x) {
      const double t = (x - DrawnPicture::middle_px) * drawn.normal.x() +
                       (y - DrawnPicture::middle_px) * drawn.normal.y() - edge.offset_px;
      const double half = 0.5 * edge.width_px;
      const double s = edge.width_px > 0.0 ? share(t + half) - share(t - half) : share(t);
      for (std::size_t c = 0; c < 3; ++c) {
        const double light = edge.before[c] + s * (edge.paint[c] - edge.before[c]) + edge.noise * noise(generator);
        const double value = 255.0 * std::pow(std::clamp(light, 0.0, 1.0), 1.0 / edge.gamma);
        drawn.pixels[k++] = static_cast<std::uint8_t>(std::lround(value));
      }
    }
  }
  return drawn;
}

}  // namespace hogline::vision::testing
