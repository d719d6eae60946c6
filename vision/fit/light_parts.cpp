#include "vision/fit/light_parts.hpp"

#include <algorithm>

namespace hogline::vision {
namespace {

constexpr float blue = 0.114F;  // of brightness, as the eye has it
constexpr float green = 0.587F;
constexpr float red = 0.299F;

}  // namespace

PixelColours in_parts(const PixelColours& light) {
  PixelColours parts(light.rows(), 3);
  parts.col(0) = blue * light.col(0) + green * light.col(1) + red * light.col(2);
  parts.col(1) = light.col(2) - parts.col(0);
  parts.col(2) = light.col(0) - parts.col(0);
  return parts;
}

Light parts_of(const Light& bgr) {
  const double light = double{blue} * bgr[0] + double{green} * bgr[1] + double{red} * bgr[2];
  return {light, bgr[2] - light, bgr[0] - light};
}

// Beside the colour's own direction another colour is seen.
double likeness(const Light& seen, const Light& wanted) {
  const double square = wanted.tail<2>().squaredNorm();
  if (!(square > 1e-4)) return 0.0;
  const double part = std::clamp(seen.tail<2>().dot(wanted.tail<2>()) / square, 0.0, 1.0);
  const double off = (seen.tail<2>() - part * wanted.tail<2>()).squaredNorm() / (0.25 * square);
  return part * std::max(0.0, 1.0 - off);
}

Light from_parts(const Light& parts) {
  const double b = parts[0] + parts[2];
  const double r = parts[0] + parts[1];
  return {b, (parts[0] - double{blue} * b - double{red} * r) / double{green}, r};
}

}  // namespace hogline::vision
