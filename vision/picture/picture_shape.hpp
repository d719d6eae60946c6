// Whether a picture is of the camera that it is said to be of, before anybody looks at it.
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

#include "vision/geometry/lens.hpp"

namespace hogline::vision {

/// Why a picture can not be one of this camera, in colour; empty where it can.
std::string shape_fault(const cv::Mat& picture, const Intrinsics& camera);

}  // namespace hogline::vision
