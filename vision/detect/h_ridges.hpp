// Places where paint as wide as a hog line may cross a picture column: dark between two lighter sides, for the ground
// width that the mount predicts there. Width tells the hog line (0.1016 m) from every other line across (0.0127 m),
// near by from its two edges, far off (where it is about a pixel) from how much light it takes away.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "vision/detect/ground_view.hpp"
#include "vision/detect/ice_light.hpp"
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

  /// The light of a picture of the setup's size, from row top() on. Every block's local maxima, block by block.
  std::vector<HogRidge> find(const IceLight& light);

  /// The first row that is searched; even.
  int top() const { return top_; }

  int blocks() const { return blocks_; }
  /// Of the last picture, at a line's middle: how much light paint of a hog line's width takes away there, 0..1; about
  /// zero, of either sign, on bare ice. Nothing outside the range, or where the sides are no ice.
  std::optional<double> contrast_at(int block, double row_px) const;

  const SheetCamera& camera() const { return camera_; }
  /// The middle of a block of columns, px.
  double column_px(int block) const { return block * block_px + 0.5 * (block_px - 1); }

  int block_of(double column_px) const { return static_cast<int>(column_px) / block_px; }

  static constexpr int block_px = 4;

 private:
  void gather(const IceLight& light);
  void search(int block, std::vector<HogRidge>& found) const;

  /// Light in the paint and beside it, if a hog line's middle were in this row.
  struct Profile {
    float inside;
    float above;
    float below;
    float taken;  ///< rows' worth of light, over the rows the paint's blur reaches
    float strength() const { return 1.0F - inside / std::min(above, below); }
  };
  std::optional<Profile> profile(int block, int row) const;

  /// Where the light crosses a level above and below a row, px rows from the top of the searched part.
  struct Edges {
    double far_px;
    double near_px;
  };
  Edges edges(int block, int row, double level) const;

  const GroundView& view_;
  SheetCamera camera_;
  int top_;
  int rows_;
  int blocks_;
  std::vector<float> thickness_px_;  ///< of hog-line paint, [block][row]; NaN where there is no ice in range
  std::vector<float> linear_;        ///< over white, of the sum of a block's pixels
  std::vector<float> light_;         ///< darkest colour over white, [block][row]
  std::vector<float> sum_;           ///< its running sum, [block][row], one more than there are rows
};

}  // namespace hogline::vision
