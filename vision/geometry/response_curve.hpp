// The camera's response: pixel = linear^(1/gamma). Edges are located in linear light (measured on rendered scenes: with
// gamma 2.2 a ring's edge moves by 0.27 px, linearised by 0.02 px).
#pragma once

#include <array>
#include <cstdint>

namespace hogline::vision {

class ResponseCurve {
 public:
  /// Precondition: gamma is finite and positive.
  explicit ResponseCurve(double gamma);

  /// Linear light in [0, 1] of an 8-bit pixel value.
  float linear(std::uint8_t value) const { return linear_[value]; }

  /// Linear light of an interpolated pixel value in [0, 255]; outside it is clamped.
  float linear(float value) const;

  double gamma() const { return gamma_; }

 private:
  double gamma_;
  std::array<float, 257> linear_{};  ///< one more than there are values, so that interpolation needs no branch
};

}  // namespace hogline::vision
