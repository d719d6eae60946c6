// The pixels in which one stone's outline is seen, in linear light against white ice.
#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "vision/fit/stone_region.hpp"
#include "vision/geometry/response_curve.hpp"
#include "vision/geometry/sheet_camera.hpp"

namespace hogline::vision {

using Light = Eigen::Vector3d;  ///< blue, green, red; 1 is white ice

struct StonePixel {
  SightLine sight;
  Eigen::Vector2d pixel;
  Light light;
  Light behind;        ///< what would be seen without the stone
  bool usable = true;  ///< its background is known and nothing nearer hides it
};

/// Where pixels come from, and against what their light is measured.
struct PatchSource {
  const cv::Mat& bgr;  ///< CV_8UC3
  const ResponseCurve& response;
  Light white;  ///< linear light of white ice near the stone

  /// Bilinear in linear light; nothing outside the picture.
  bool light_at(const Eigen::Vector2d& pixel, Light& light) const;
};

/// Pixels on and about the outlines of handle and body, thinned to about `most`. Empty where the stone is not in the
/// picture.
std::vector<StonePixel> stone_pixels(const PatchSource& source, const SheetCamera& camera, const StonePlace& stone,
                                     std::size_t most);

/// Looks outward past the stone's outline for what is behind it. Pixels for which that can not be told are marked.
void look_behind(const PatchSource& source, const StonePlace& stone, const Eigen::Vector3d& eye,
                 const Light& handle_colour, std::vector<StonePixel>& pixels);

}  // namespace hogline::vision
