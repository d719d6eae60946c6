// Candidates for the hog line: ridges of its width that line up on the ice, by a Hough transform in metric ground
// coordinates.
#pragma once

#include <string>
#include <vector>

#include "vision/detect/h_ridges.hpp"

namespace hogline::vision {

/// A line across on the ice: ground . (sin yaw, cos yaw) = distance, for a body at `yaw`.
struct CrossCandidate {
  double yaw_rad = 0.0;
  double distance_m = 0.0;  ///< from b's origin, along e's y, to the paint's middle
  int supporters = 0;       ///< blocks of columns in which it was seen
  double visible = 0.0;     ///< share of the columns, within the narrowest sheet about the body, in which it was seen
  double contrast = 0.0;    ///< median of the ridges'
  double width_m = 0.0;     ///< median of the ridges'; 0 where too few pixels tell
  double begin_x_m = 0.0;   ///< its ends, to the right of the body in ground coordinates
  double end_x_m = 0.0;

  Eigen::Vector2d normal() const;  ///< e's y axis in ground coordinates
  Eigen::Vector2d at(double x_m) const;
};

/// Where to look, given what is known beforehand.
struct CrossRange {
  double min_yaw_rad = -0.262;
  double max_yaw_rad = 0.262;
  double min_distance_m = 0.3;
  double max_distance_m = 11.0;
};

/// The best supported first, at most `most`; those whose width or contrast says that they are no hog line are left out,
/// and counted in `too_thin` where that is given.
std::vector<CrossCandidate> find_cross_candidates(const std::vector<HogRidge>& ridges, const HogRidgeFinder& finder,
                                                  const GroundView& view, const CrossRange& range, std::size_t most,
                                                  int* too_thin = nullptr);

}  // namespace hogline::vision
