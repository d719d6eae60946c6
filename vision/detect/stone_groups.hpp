// Coarse boxes around groups of stones, before anything else is known of the picture (Yoon et al., section III.C, first
// step): where there is as much granite as a stone's body shows below a handle.
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "vision/camera_setup.hpp"
#include "vision/detect/white_light.hpp"
#include "vision/geometry/stone_shape.hpp"

namespace hogline::vision {

struct StoneGroups {
  std::vector<cv::Rect> boxes;  ///< pixels, handles and grips included, not overlapping
  cv::Mat centres;              ///< CV_8UC1 at half size from row `top`: 255 where a handle's centre may be
  int top = 0;                  ///< a multiple of four
};

/// Of a picture in which stones are known already.
struct GroupSearch {
  int first_row = 0;                              ///< handles' centres from here
  int last_row = 0;                               ///< to before here
  std::vector<std::vector<cv::Point>> explained;  ///< convex, pixels: granite in there is a known stone's
};

/// Needs the mount only. Far stones are looked for at half the picture's size, near ones at a quarter. Granite is
/// neutral grey, darker than ice and lighter than black: it is told from paint by its colour, from lines and dividers
/// by its extent. Trousers and shadows may pass; what is in a box is judged later.
class StoneGroupFinder {
 public:
  StoneGroupFinder(const CameraSetup& setup, const StoneShape& shape);

  /// Precondition: CV_8UC3 of the setup's size.
  StoneGroups find(const cv::Mat& bgr, const WhiteLight& ice, const ResponseCurve& response);

  /// Only where handles' centres may be (`boxes` stays empty), for granite that nothing explains.
  StoneGroups find_unexplained(const cv::Mat& bgr, const WhiteLight& ice, const ResponseCurve& response,
                               const GroupSearch& search);

  /// Rows in about `count` parts that cost as much as each other: where part `number` begins.
  int part_begins(int number, int count) const;

  /// The first row in which ice of interest can lie.
  int top() const { return top_; }

 private:
  static constexpr int block_px = 16;
  static constexpr int white_px = 32;  ///< in which white ice is as light everywhere

  static constexpr int cell_px = 8;
  static constexpr int margin = 48;  ///< steps; beyond any rectangle below

  /// Relative to a place, in a band's steps; ends are exclusive.
  struct Rectangle {
    int left = 0, right = 0, top = 0, bottom = 0;
    int area() const { return (right - left) * (bottom - top); }
    int count(const int* sums, int row) const {
      return sums[bottom * row + right] - sums[bottom * row + left] - sums[top * row + right] + sums[top * row + left];
    }
    /// Of places beside each other.
    void count(const int* sums, int row, int places, int* counts) const {
      const int* low_right = sums + bottom * row + right;
      const int* low_left = sums + bottom * row + left;
      const int* high_right = sums + top * row + right;
      const int* high_left = sums + top * row + left;
      for (int i = 0; i < places; ++i) counts[i] = low_right[i] - low_left[i] - high_right[i] + high_left[i];
    }
  };

  /// What a stone covers whose handle's centre is in the middle of a block, relative to it, in pixels.
  struct Extent {
    bool seen = false;
    float half_width = 0.0F;   ///< of the whole stone
    float granite_top = 0.0F;  ///< where the handle ends
    float above = 0.0F;        ///< the grip's top
    float below = 0.0F;        ///< the body's foot
    Rectangle body, handle;
    int least_body = 0;   ///< granite in the body's rectangle, steps
    int most_handle = 0;  ///< and in the handle's

    void choose_rectangles(float step);
  };

  /// White ice in a square of white_px.
  struct White {
    std::array<float, 3> scale;  ///< from linear light
    int light_level = 0;         ///< green from here on is too light for granite
  };

  /// Rows of the picture that are looked at in steps of so many pixels.
  struct Band {
    int top, bottom, step;
    int below;  ///< rows below that its stones reach into
  };

  Extent extent_at(const SheetCamera& camera, const Eigen::Vector2d& pixel, const StoneShape& shape) const;
  const Extent& extent(int x, int y) const {
    return extents_[static_cast<std::size_t>(y / block_px * columns_ + x / block_px)];
  }
  void choose_bands(int bottom);
  int first_big_row() const;
  void begin(const cv::Mat& bgr, StoneGroups& groups);
  void leave_out(const Band& band, const std::vector<cv::Point>& outline);
  void find_whites(const WhiteLight& ice, const ResponseCurve& response, int columns, int y);
  void find_granite(const Band& band, const cv::Mat& bgr, const WhiteLight& ice, const ResponseCurve& response);
  void mark_centres(const Band& band, int columns, cv::Mat& centres);
  std::vector<cv::Rect> boxes_of(cv::Size picture) const;

  int columns_;
  int top_;
  std::vector<Extent> extents_;
  std::array<Band, 2> bands_;
  std::vector<White> whites_;  ///< of a row of squares
  cv::Mat granite_;
  cv::Mat sums_;
  cv::Mat cells_;  ///< 255 where a centre may be
};

}  // namespace hogline::vision
