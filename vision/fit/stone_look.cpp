#include "vision/fit/stone_look.hpp"

#include <algorithm>

namespace hogline::vision {

SharedVector numbers_of(const SharedLook& look) {
  SharedVector v;
  v << look.shape.handle_thickness_m, look.shape.body_radius_m, look.shape.body_half_height_m,
      look.shape.handle_radius_m, look.wall_light, look.blur_px, look.colour_blur_px;
  return v;
}

SharedLook look_of(const SharedVector& numbers, const SharedLook& like) {
  SharedLook look = like;
  look.shape.handle_thickness_m = std::clamp(numbers[0], 0.002, 0.05);
  look.shape.body_radius_m = std::clamp(numbers[1], 0.13, 0.15);
  look.shape.body_half_height_m = std::clamp(numbers[2], 0.04, 0.08);
  look.shape.handle_radius_m = numbers[3];
  look.wall_light = std::clamp(numbers[4], 0.2, 1.2);
  look.blur_px = std::clamp(numbers[5], 0.4, 2.5);
  look.colour_blur_px = std::clamp(numbers[6], 0.4, 3.0);
  return look;
}

}  // namespace hogline::vision
