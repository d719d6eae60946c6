// A rendered scene of tests/data with its exact truth.
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

#include "vision/camera_setup.hpp"

namespace hogline::vision::testing {

struct Scene {
  cv::Mat image;      ///< CV_8UC3
  CameraSetup setup;  ///< as a rig file would give it: mount as calibrated, nominal width
  Pose eMc;           ///< true
  PlanarPose body;    ///< true
  double sheet_width_m = 0.0;
  std::string sideline;
};

/// By its name under tests/data, such as "near/near-11-000". Throws std::runtime_error when it can not be read.
Scene load_scene(const std::string& name);

/// The same by a path without its extension.
Scene load_scene_file(const std::string& base);

}  // namespace hogline::vision::testing
