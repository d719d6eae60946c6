// A profile: linear light along a short straight stroke across an expected edge in the raw picture.
#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core/mat.hpp>

#include "vision/geometry/response_curve.hpp"

namespace hogline::vision {

/// Samples every `step_px` from -half to +half along the normal; at(c)[i] is channel c at offset(i). No heap.
struct Profile {
  static constexpr int max_samples = 161;
  static constexpr double step_px = 0.5;

  int size = 0;
  std::array<std::array<float, max_samples>, 3> light{};

  double offset_px(double index) const { return (index - 0.5 * (size - 1)) * step_px; }
};

/// Reads profiles from one picture, CV_8UC3 or CV_8UC1, which must outlive the reader. Only the pixels a profile
/// touches are read; bilinear, in linear light.
class ProfileReader {
 public:
  ProfileReader(const cv::Mat& image, const ResponseCurve& response);

  /// False when the stroke leaves the picture. Precondition: `normal` is a unit vector; half_px <= 40.
  bool read(const Eigen::Vector2d& centre, const Eigen::Vector2d& normal, double half_px, Profile& profile) const;

 private:
  const cv::Mat& image_;
  const ResponseCurve& response_;
};

}  // namespace hogline::vision
