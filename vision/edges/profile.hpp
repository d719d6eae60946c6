// A cut through the raw picture along a normal, in linear light.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

#include "vision/geometry/response_curve.hpp"

namespace hogline::vision {

/// Someone else's 8-bit pixels: one channel, or three interleaved (BGR).
struct Picture {
  const std::uint8_t* pixels = nullptr;
  int width_px = 0;
  int height_px = 0;
  int channels = 0;
  std::size_t row_bytes = 0;
};

/// Samples at equal steps along the normal; sample i lies `first_px + i * step_px` from the centre.
struct Profile {
  static constexpr int max_samples = 160;
  int count = 0;
  int channels = 0;
  double first_px = 0.0;
  double step_px = 1.0;
  std::array<std::array<float, max_samples>, 3> light{};

  double position(int i) const { return first_px + i * step_px; }
};

/// Where to cut. Each sample is the mean of `2 * half_breadth + 1` interpolated values one pixel apart along the
/// tangent: noise falls by its root, and a straight edge does not move.
struct Cut {
  Eigen::Vector2d centre;  ///< pixel centres at integers
  Eigen::Vector2d normal;  ///< unit
  double first_px = 0.0;   ///< of the first sample, along the normal
  double last_px = 0.0;    ///< the last sample lies at most here
  double step_px = 1.0;
  int half_breadth = 0;
};

/// Bilinear samples; every tap is brought to linear light first. False, and an empty profile, when the cut leaves the
/// picture or has more than Profile::max_samples samples. Precondition: 1 or 3 channels, step_px > 0.
bool sample(const Picture& picture, const ResponseCurve& response, const Cut& cut, Profile& profile);

}  // namespace hogline::vision
