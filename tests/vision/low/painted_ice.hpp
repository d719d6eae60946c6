// Paints what a low camera sees of a sheet, for tests: each pixel is the mean over its footprint of stripes, rings and
// patches on the ice, seen through lens, ice and response curve. Written from the rules, not from the detector.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vision/camera_setup.hpp"

namespace hogline::vision::testing {

using Colour = Eigen::Vector3f;  ///< linear light, B G R

inline const Colour white{0.75F, 0.78F, 0.76F};
inline const Colour red{0.05F, 0.03F, 0.5F};
inline const Colour blue{0.45F, 0.08F, 0.05F};
inline const Colour black{0.02F, 0.02F, 0.02F};
inline const Colour yellow{0.04F, 0.55F, 0.7F};

/// A rectangle on the ice, in e.
struct Patch {
  double x_m[2];
  double y_m[2];
  Colour colour;
};

struct PaintedSheet {
  PlanarPose body;
  double lean_rad = 0.0;  ///< the camera looks down by so much more than its mount
  bool hog_line = true;
  bool centre_line = true;
  bool rings = true;
  bool house_beyond = false;  ///< another house beyond the hog line, as before the other end's
  double width_m = 4.75;
  std::optional<double> left_sideline_m = 0.05;  ///< paint's width; empty: none
  std::optional<double> right_sideline_m = 0.05;
  Colour hog_colour = red;
  Colour line_colour = black;
  Colour side_colour = blue;
  std::vector<Patch> patches;  ///< over everything else, in order
  double noise = 0.004;        ///< of linear light
  std::uint64_t seed = 1;
};

/// A wide-angle camera half a metre over the ice, 0.45 m ahead of the body, looking 20 degrees down.
CameraSetup low_camera();

/// CV_8UC3 of the setup's size. A dark hall stands above the horizon.
cv::Mat paint(const CameraSetup& setup, const PaintedSheet& sheet);

}  // namespace hogline::vision::testing
