#include "vision/plain/undistortion.hpp"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace hogline::vision::plain {

Undistortion::Undistortion(const Intrinsics& k) : matrix_(k.fx_px, 0.0, k.cx_px, 0.0, k.fy_px, k.cy_px, 0.0, 0.0, 1.0) {
  const cv::Size size(k.width_px, k.height_px);
  if (k.model == LensModel::kannala_brandt) {
    const cv::Vec4d d(k.distortion[0], k.distortion[1], k.distortion[2], k.distortion[3]);
    cv::fisheye::initUndistortRectifyMap(matrix_, d, cv::noArray(), matrix_, size, CV_16SC2, map_, map_fraction_);
  } else {
    const cv::Mat d(1, 5, CV_64F, const_cast<double*>(k.distortion.data()));
    cv::initUndistortRectifyMap(matrix_, d, cv::noArray(), matrix_, size, CV_16SC2, map_, map_fraction_);
  }
}

const cv::Mat& Undistortion::apply(const cv::Mat& image) {
  cv::remap(image, undistorted_, map_, map_fraction_, cv::INTER_LINEAR);
  return undistorted_;
}

}  // namespace hogline::vision::plain
