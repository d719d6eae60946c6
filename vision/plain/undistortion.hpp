// The whole picture without the lens's distortion, as methods want it that know nothing of lenses. The maps are made
// once, in fixed point, which is OpenCV's fastest way; the camera matrix stays, as cv::undistort keeps it, so that the
// picture's middle keeps its resolution. 17 % of the near camera's picture, in its corners, leaves the frame.
#pragma once

#include <opencv2/core/mat.hpp>

#include "vision/geometry/lens.hpp"

namespace hogline::vision::plain {

class Undistortion {
 public:
  explicit Undistortion(const Intrinsics& intrinsics);

  /// Any number of channels; the result is overwritten by the next call.
  const cv::Mat& apply(const cv::Mat& image);

  /// The camera matrix of the undistorted picture.
  const cv::Matx33d& matrix() const { return matrix_; }

 private:
  cv::Matx33d matrix_;
  cv::Mat map_;
  cv::Mat map_fraction_;
  cv::Mat undistorted_;
};

}  // namespace hogline::vision::plain
