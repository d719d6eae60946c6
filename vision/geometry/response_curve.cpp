#include "vision/geometry/response_curve.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace hogline::vision {

ResponseCurve::ResponseCurve(double gamma) : gamma_(gamma) {
  assert(std::isfinite(gamma) && gamma > 0.0);
  for (std::size_t i = 0; i < 256; ++i) {
    linear_[i] = static_cast<float>(std::pow(static_cast<double>(i) / 255.0, gamma));
  }
  linear_[256] = linear_[255];
}

float ResponseCurve::linear(float value) const {
  const float v = std::clamp(value, 0.0F, 255.0F);
  const auto i = static_cast<std::size_t>(v);
  const float t = v - static_cast<float>(i);
  return linear_[i] + t * (linear_[i + 1] - linear_[i]);
}

}  // namespace hogline::vision
