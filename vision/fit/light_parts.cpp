#include "vision/fit/light_parts.hpp"

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

Light from_parts(const Light& parts) {
  const double b = parts[0] + parts[2];
  const double r = parts[0] + parts[1];
  return {b, (parts[0] - double{blue} * b - double{red} * r) / double{green}, r};
}

}  // namespace hogline::vision
