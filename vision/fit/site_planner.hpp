// Where in the picture to look for paint: sites along the features' projections, clear of other paint.
#pragma once

#include <vector>

#include "vision/fit/painted_features.hpp"
#include "vision/geometry/sheet_camera.hpp"

namespace hogline::vision {

/// A place on a feature and how its pixel moves.
struct PlannedSite {
  int feature = 0;
  Eigen::Vector2d paint;  ///< in e
  Eigen::Vector2d pixel;
  Eigen::Vector2d normal;               ///< unit, in the picture, towards the feature's `across`
  Eigen::Matrix<double, 1, 6> by_pose;  ///< along the normal
  double by_across_px_per_m = 0.0;      ///< along the normal, for the feature moved along its `across`
  double line_width_px = 0.0;           ///< 0: an edge
};

struct PlanOptions {
  double spacing_px = 8.0;  ///< between sites on one feature
  double search_px = 3.0;   ///< other paint must be farther than this, and the filter's reach, along the normal
  double blur_px = 1.0;
  bool coarse_only = false;
};

/// Fills `sites` (its memory is reused). A line wider than a few blurs becomes two rows of edges.
void plan_sites(const std::vector<PaintedFeature>& features, const SheetCamera& camera, const PlanOptions& options,
                std::vector<PlannedSite>& sites);

}  // namespace hogline::vision
