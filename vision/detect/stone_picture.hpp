// A picture in which stones are looked for, and what is known of it before any is found.
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "vision/detect/white_light.hpp"
#include "vision/geometry/response_curve.hpp"
#include "vision/geometry/sheet_camera.hpp"
#include "vision/geometry/stone_shape.hpp"

namespace hogline::vision {

/// Everything is kept by reference.
struct StonePicture {
  const cv::Mat& bgr;  ///< CV_8UC3
  const ResponseCurve& response;
  const WhiteLight& ice;
  const SheetCamera& camera;
  const StoneShape& shape;

  Eigen::Vector3d eye() const { return camera.eMc().translation(); }
};

}  // namespace hogline::vision
