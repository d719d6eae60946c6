// Places where paint as wide as a hog line may cross a picture column: dark between two lighter sides, for the ground
// width that the mount predicts there. Width tells the hog line (0.1016 m) from every other line across (0.0127 m),
// near by from its two edges, far off (where it is about a pixel) from how much light it takes away.
#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "vision/detect/ground_view.hpp"
#include "vision/geometry/response_curve.hpp"
#include "vision/geometry/sheet_camera.hpp"

namespace hogline::vision {

struct HogRidge {
  Eigen::Vector2d pixel;  ///< of the paint's middle
  Eigen::Vector2d ice;    ///< the paint there, GroundView's ground coordinates, through the ice
  int column = 0;         ///< block of picture columns
  double strength = 0.0;  ///< how much darker than both sides, 0..1
  double contrast = 0.0;  ///< of paint 0.1016 m wide that takes away as much light; a thin line stays below 0.13
  double width_m = 0.0;   ///< between its edges, along y; 0 where too few pixels tell
};

class HogRidgeFinder {
 public:
  /// `view` must outlive it. Ice farther than `range_m` from the body is left out.
  HogRidgeFinder(const GroundView& view, double range_m);

  /// `image` is CV_8UC3 or CV_8UC1 of the setup's size. Every block's local maxima, block by block.
  std::vector<HogRidge> find(const cv::Mat& image);

  int blocks() const { return blocks_; }
  /// The middle of a block of columns, px.
  double column_px(int block) const { return block * block_px + 0.5 * (block_px - 1); }

  static constexpr int block_px = 4;

 private:
  void whiten(const cv::Mat& image);
  void darkest(const cv::Mat& image);
  void search(int block, std::vector<HogRidge>& found);
  double measured_width(int block, int row, double level) const;

  const GroundView& view_;
  ResponseCurve response_;
  SheetCamera camera_;
  int top_;
  int rows_;
  int blocks_;
  std::vector<float> thickness_px_;  ///< of hog-line paint, [block][row]; NaN where there is no ice in range
  std::array<std::array<float, 256>, 3> white_{};
  std::vector<float> light_;  ///< darkest colour over white, [block][row]
  std::vector<float> sum_;    ///< running sum of one block
};

}  // namespace hogline::vision
