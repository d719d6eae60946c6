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

  /// The lines of sight of one row: polynomials of the column.
  class Row {
   public:
    /// Puts a pixel's line of sight in `sights` at `at`.
    void find(int x, Eigen::Index at, SightLines& sights) const {
      const float u = static_cast<float>(x - left_) * by_column_;
      const Eigen::Array4f all = terms_[0] + u * (terms_[1] + u * terms_[2]);  // x, y, and both by row
      const Eigen::Array2f turn = by_column_ * (terms_[1].head<2>() + 2.0F * u * terms_[2].head<2>());
      sights.x[at] = all[0];
      sights.y[at] = all[1];
      sights.x_by_row[at] = all[2];
      sights.y_by_row[at] = all[3];
      sights.x_by_column[at] = turn[0];
      sights.y_by_column[at] = turn[1];
    }

   private:
    friend class SightTable;
    int left_ = 0;
    float by_column_ = 0.0F;
    std::array<Eigen::Array4f, 3> terms_;  ///< of rising order
  };
  Row row(int y) const;

 private:
  cv::Rect area_;
  float by_column_;
  float by_row_;
  bool ok_ = true;
  std::array<std::array<Eigen::Array2f, 3>, 3> terms_;  ///< by the orders of row and column
};

}  // namespace hogline::vision
