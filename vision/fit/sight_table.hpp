// Lines of sight of a small rectangle of the picture, quickly.
#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core/types.hpp>

#include "vision/fit/stone_region.hpp"
#include "vision/geometry/sheet_camera.hpp"

namespace hogline::vision {

/// By second-order interpolation between nine of them. Precondition: `area` is at least two pixels wide and high.
class SightTable {
 public:
  SightTable(const SheetCamera& camera, const cv::Rect& area);

  /// False where the horizon is in the rectangle, or what the lens can not see.
  bool ok() const { return ok_; }

  /// Puts the pixel's line of sight in `sights` at `at`.
  void find(int x, int y, Eigen::Index at, SightLines& sights) const;

 private:
  cv::Rect area_;
  float by_column_;
  float by_row_;
  bool ok_ = true;
  std::array<Eigen::Vector2f, 9> knots_;
};

}  // namespace hogline::vision
