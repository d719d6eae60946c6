// The house's colours by k-means, inside the area that hog line and sidelines bound, on a grid of the ice.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

#include "vision/detect/ground_view.hpp"
#include "vision/detect/line_classes.hpp"
#include "vision/geometry/response_curve.hpp"

namespace hogline::vision {

/// A grid on the ice: cell (row, column) lies at origin + column * cell_m to the right and row * cell_m ahead.
struct IceGrid {
  Eigen::Vector2d origin;
  double cell_m = 0.0;
  Eigen::Vector2d at(double column, double row) const { return origin + cell_m * Eigen::Vector2d(column, row); }
};

struct HouseSegmentation {
  IceGrid grid;
  cv::Mat outer_ring;  ///< CV_8UC1, 255 where the outer ring's colour is
};

/// The lines that bound the area; a missing sideline is replaced by the widest sheet about the body.
struct HouseArea {
  std::optional<ClassifiedLine> hog;
  std::optional<ClassifiedLine> left;
  std::optional<ClassifiedLine> right;
};

/// Three colours: ice, outer ring, inner ring. Ice is the lightest; of the other two the outer ring is the larger one.
/// Light that changes over the sheet is divided out by the brightest ice near by. Nothing where there are not three
/// colours to tell apart.
std::optional<HouseSegmentation> segment_house(const cv::Mat& image, const ResponseCurve& response,
                                               const GroundView& view, const HouseArea& area);

}  // namespace hogline::vision
