// vision/plain's undistortion, timed: part of what a method costs that knows nothing of lenses.
#pragma once

#include "tests/bench/processor_time.hpp"
#include "vision/plain/undistortion.hpp"

namespace hogline::bench {

class Undistortion {
 public:
  explicit Undistortion(const vision::Intrinsics& intrinsics) : undistortion_(intrinsics) {}

  /// Any number of channels; the result is overwritten by the next call. Adds the processor time to `spent_s`.
  const cv::Mat& apply(const cv::Mat& image, double& spent_s) {
    const double begin_s = processor_time_s();
    const cv::Mat& flat = undistortion_.apply(image);
    spent_s += processor_time_s() - begin_s;
    return flat;
  }

  /// The camera matrix of the undistorted picture.
  const cv::Matx33d& matrix() const { return undistortion_.matrix(); }

 private:
  vision::plain::Undistortion undistortion_;
};

}  // namespace hogline::bench
