#include "vision/detect/granite.hpp"

#include <cmath>
#include <numbers>

namespace hogline::vision {

double granite_share(const StonePicture& picture, const Eigen::Vector2d& place) {
  const SheetCamera& camera = picture.camera;
  const StoneShape& shape = picture.shape;
  const Bearing bearing = bearing_of(place, camera.eMc().translation());
  const auto centre = camera.project({place.x(), place.y(), shape.handle_height_m});
  if (!centre) return 0.0;
  const auto white = picture.ice.at(centre->x(), centre->y());
  int granite = 0;
  int tried = 0;
  for (const double height_m : {0.05, 0.07, 0.09}) {
    // The body's girth at that height, as an ellipsoid has it.
    const double up = height_m / shape.body_half_height_m - 1.0;
    const double radius_m = shape.body_radius_m * std::sqrt(std::max(0.0, 1.0 - up * up));
    for (int i = 0; i < 8; ++i) {
      const double angle = -std::numbers::pi * (0.12 + 0.76 * i / 7.0);
      const auto pixel = camera.project(circle_point(place, bearing, radius_m, height_m, angle));
      if (!pixel || !camera.lens().in_picture(*pixel, 1.0)) continue;
      const std::uint8_t* p = picture.bgr.ptr<std::uint8_t>(static_cast<int>(std::lround(pixel->y()))) +
                              3 * static_cast<int>(std::lround(pixel->x()));
      granite += may_be_granite(picture.response.linear(p[0]) / white[0], picture.response.linear(p[1]) / white[1],
                                picture.response.linear(p[2]) / white[2])
                     ? 1
                     : 0;
      ++tried;
    }
  }
  return tried > 0 ? static_cast<double>(granite) / tried : 0.0;
}

}  // namespace hogline::vision
