// The house's centre by votes: every edge point of three concentric rings of known radii points at it.
#pragma once

#include <optional>
#include <vector>

#include "vision/detect/edge_points.hpp"
#include "vision/detect/line_classes.hpp"

namespace hogline::vision {

struct RingVote {
  Eigen::Vector2d centre;  ///< of the house, ground coordinates, m
  int supporters = 0;      ///< edge points that lie on one of the three circles about it
  int arcs = 0;            ///< of 24 on each of three circles, those with supporters: a straight edge has few
};

/// Needs neither lines nor colours, and no whole ring: occluded and cut rings still vote. Nothing where no place
/// gathers enough votes.
std::optional<RingVote> vote_for_house(const std::vector<EdgePoint>& points, const StandingRange& range);

}  // namespace hogline::vision
