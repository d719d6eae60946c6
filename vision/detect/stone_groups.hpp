// Coarse boxes around groups of stones, before anything else is known of the picture (Yoon et al., section III.C, first
// step): where there is as much granite as a stone's body shows below a handle.
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "vision/camera_setup.hpp"
#include "vision/detect/white_light.hpp"
#include "vision/geometry/stone_shape.hpp"

namespace hogline::vision {

struct StoneGroups {
  std::vector<cv::Rect> boxes;  ///< pixels, handles and grips included, not overlapping
  cv::Mat centres;              ///< CV_8UC1 at half size from row `top`: 255 where a handle's centre may be
  int top = 0;                  ///< even
};

/// Needs the mount only. Granite is neutral grey, darker than ice and lighter than black: it is told from paint by its
/// colour, from lines and dividers by its extent. Trousers and shadows may pass; what is in a box is judged later.
class StoneGroupFinder {
 public:
  StoneGroupFinder(const CameraSetup& setup, const StoneShape& shape);

  /// Precondition: CV_8UC3 of the setup's size.
  StoneGroups find(const cv::Mat& bgr, const WhiteLight& ice, const ResponseCurve& response) const;

  /// The first row in which ice of interest can lie.
  int top() const { return top_; }

 private:
  static constexpr int block_px = 16;

  /// What a stone covers whose handle's centre is in the middle of a block, relative to it, in pixels.
  struct Extent {
    bool seen = false;
    float side = 0.0F;         ///< half the width of the granite that must be there
    float granite_top = 0.0F;  ///< from the handle down
    float granite_bottom = 0.0F;
    float handle_side = 0.0F;  ///< of a part of the handle's face
    float handle_depth = 0.0F;
    float half_width = 0.0F;  ///< of the whole stone
    float above = 0.0F;       ///< the grip's top
    float below = 0.0F;       ///< the body's foot
  };

  Extent extent_at(const SheetCamera& camera, const Eigen::Vector2d& pixel, const StoneShape& shape) const;
  const Extent& extent(int x, int y) const {
    return extents_[static_cast<std::size_t>(y / block_px * columns_ + x / block_px)];
  }
  cv::Mat granite(const cv::Mat& bgr, const WhiteLight& ice, const ResponseCurve& response) const;
  static bool may_be_centre(const Extent& e, const cv::Mat& sums, int c, int r);
  cv::Mat possible_centres(const cv::Mat& granite) const;
  std::vector<cv::Rect> boxes_of(const cv::Mat& centres, cv::Size picture) const;

  int columns_;
  int top_;
  std::vector<Extent> extents_;
};

}  // namespace hogline::vision
