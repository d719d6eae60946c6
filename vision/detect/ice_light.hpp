// How light the ice is, for every search of the low view: each pixel's darkest colour against the ice's white. Ice is
// white, so paint of any colour is dark in one of them.
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace hogline::vision {

class IceLight {
 public:
  /// Pictures are read from row `top` (even) downwards.
  explicit IceLight(int top) : top_(top) {}

  /// `image` is CV_8UC3, with two rows below `top` at least. Its white is each colour's upper quartile: most
  /// of what lies below the horizon is ice.
  void read(const cv::Mat& image);

  int top() const { return top_; }
  /// CV_8UC1 in the picture's response curve, row 0 is row `top`; ice is about `white` (less in a picture too dark to
  /// be brought there), lamps are lighter.
  const cv::Mat& darkest() const { return darkest_; }
  /// The same at half the size, each the mean of four.
  const cv::Mat& half() const { return half_; }

  static constexpr int white = 192;

 private:
  int top_;
  cv::Mat darkest_;
  cv::Mat half_;
};

}  // namespace hogline::vision
