// How the camera leans against its mount while the body rocks: 0.1 degrees of it are 32 mm of distance at 3 m. Whatever
// is painted tells: with the right lean the sidelines are parallel, and the rings round and 4.572 m short of the hog
// line.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "vision/detect/edge_points.hpp"
#include "vision/detect/h_lines.hpp"

namespace hogline::vision {

inline constexpr double lean_sigma_rad = 0.0045;  ///< the running body rocks by tenths of a degree

/// Ground coordinates if the camera looked down by `lean_rad` more than its mount says.
Eigen::Vector2d leaned(const Eigen::Vector2d& ground, double lean_rad, const GroundView& view);

/// The centre line as seen without a lean.
struct CentreLine {
  double x_m = 0.0;  ///< where it meets the hog line, to the right of the foot of b's perpendicular
  /// Two of its points in ground coordinates, the nearer first; empty: it is only inferred.
  std::optional<std::pair<Eigen::Vector2d, Eigen::Vector2d>> seen;
};

/// The body before a hog line seen with that lean.
PlanarPose body_before(const CrossCandidate& hog, const CentreLine& centre, double lean_rad, const GroundView& view);

struct LeanVote {
  double lean_rad = 0.0;
  double sigma_rad = 0.0;     ///< how far the lean may be off: half the breadth of the votes' peak
  int sideline_points = 0;    ///< on one pair of lines as far from the centre line as sidelines may be
  double width_m = 0.0;       ///< between these lines: the innermost of those nearly as well seen as the best
  int ring_points = 0;        ///< on the outer, middle or inner ring
  double ring_shift_m = 0.0;  ///< how much farther along e's y than the hog line says the rings say the body is
};

/// Every edge point votes for the leans with which it lies on the sheet. Nothing where too little is painted in view.
std::optional<LeanVote> vote_for_lean(const std::vector<EdgePoint>& points, const CrossCandidate& hog,
                                      const CentreLine& centre, const GroundView& view);

}  // namespace hogline::vision
