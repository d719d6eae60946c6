// Votes for stones' centres (Yoon et al., section III.C, third step): the handle's boundary is a circle of known radius
// at a known height, so that every place has one known outline in the picture, and every edge pixel on it that runs the
// right way is a vote. The body's sides vote too. Peaks are taken one by one, each with what lies within a stone.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "vision/detect/stone_groups.hpp"
#include "vision/detect/stone_picture.hpp"

namespace hogline::vision {

struct StoneCandidate {
  Eigen::Vector2d place;  ///< in e, within a pixel of the true one
  Eigen::Vector2d pixel;  ///< of the handle's centre
  double votes = 0.0;     ///< share of the outline, 0..1
  double handle_votes = 0.0;
  double body_votes = 0.0;
};

/// Where on the sheet stones are looked for, in e.
struct StoneArea {
  double half_width_m = 2.7;
  double min_y_m = -4.0;
  double max_y_m = 7.0;
  bool contains(const Eigen::Vector2d& place) const {
    return std::abs(place.x()) <= half_width_m && place.y() >= min_y_m && place.y() <= max_y_m;
  }
  StoneArea wider(double by_m) const { return {half_width_m + by_m, min_y_m - by_m, max_y_m + by_m}; }
};

struct StoneVoteOptions {
  StoneArea area;
  double least_votes = 0.26;
  std::size_t most_candidates = 120;
};

/// Candidates of all boxes, by falling votes.
std::vector<StoneCandidate> vote_for_stones(const StonePicture& picture, const StoneGroups& groups,
                                            const StoneVoteOptions& options = {});

}  // namespace hogline::vision
