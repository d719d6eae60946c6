// How bright white ice is, place by place, channel by channel: what every colour on the sheet is measured against, so
// that lamps, shade and vignetting do not make colours of their own.
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "vision/geometry/response_curve.hpp"

namespace hogline::vision {

class WhiteLight {
 public:
  static constexpr int block_px = 64;

  /// Looks at every fourth pixel from row `top` down. A high percentile of each block, which lamps' reflections do not
  /// reach, in the one colour that white ice has in this light, and the best of the blocks around, for those that paint
  /// fills. Precondition: CV_8UC3, not empty.
  WhiteLight(const cv::Mat& bgr, const ResponseCurve& response, int top);

  /// The same light of a picture `scale` times smaller (1: as large), the whole of which was averaged.
  WhiteLight in_smaller(double scale) const;

  /// Linear light of white ice at a pixel: blue, green, red; never zero.
  std::array<float, 3> at(double x, double y) const;

 private:
  int top_;
  int columns_;
  int rows_;
  double scale_ = 1.0;  ///< of this picture's pixels, in those that were looked at
  std::vector<std::array<float, 3>> light_;
};

}  // namespace hogline::vision
