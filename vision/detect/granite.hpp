// What granite looks like: neutral grey, darker than ice and lighter than black.
#pragma once

#include <algorithm>

#include "vision/detect/stone_picture.hpp"

namespace hogline::vision {

inline constexpr float lightest_granite = 0.62F;

/// Light against white ice, of the three channels in any order. Noise alone makes grey a little coloured.
inline bool may_be_granite(float a, float b, float c) {
  constexpr float darkest = 0.09F;
  constexpr float least_spread = 0.03F;
  constexpr float most_spread = 0.38F;  // of the brightest channel
  const float high = std::max({a, b, c});
  return high > darkest && high < lightest_granite && high - std::min({a, b, c}) < least_spread + most_spread * high;
}

/// How much of the front of a stone's body, below its handle, may be granite: 0..1.
double granite_share(const StonePicture& picture, const Eigen::Vector2d& place);

}  // namespace hogline::vision
