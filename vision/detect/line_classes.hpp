// Line candidates classified by slope and intercept on the ice, using the roughly known pose.
#pragma once

#include <vector>

#include "vision/detect/ground_view.hpp"
#include "vision/detect/line_candidates.hpp"

namespace hogline::vision {

/// Where a robot before its house can stand: the search ranges of NearView::acquire().
struct StandingRange {
  double max_x_m = 1.2;
  double min_y_m = -5.5;  ///< in e
  double max_y_m = -1.5;
  double max_yaw_rad = 0.262;
};

/// A candidate on the ice. `slope_rad` is its direction from straight ahead (down-ice lines) or from straight to the
/// right (lines across), counter-clockwise positive: for a sheet line it is minus the body's yaw.
struct ClassifiedLine {
  LineCandidate line;
  double slope_rad = 0.0;
  double intercept_m = 0.0;  ///< distance from b's origin: ahead for lines across, to the right for lines down-ice
};

struct LineClasses {
  std::vector<ClassifiedLine> hog;
  std::vector<ClassifiedLine> left;
  std::vector<ClassifiedLine> right;
  std::vector<ClassifiedLine> across;    ///< every line that could be a sheet's line across
  std::vector<ClassifiedLine> down_ice;  ///< every line that could run down-ice
};

LineClasses classify(const std::vector<LineCandidate>& lines, const GroundView& view, const StandingRange& range);

/// The direction in which most of the paint agrees: the body's yaw in e, by the lines across and down-ice together.
/// Nothing when there are no lines.
std::optional<double> consensus_yaw(const LineClasses& classes);

}  // namespace hogline::vision
