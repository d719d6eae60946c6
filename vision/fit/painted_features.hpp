// The paint that a fit can hold on to, as curves in the end's frame e.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "vision/geometry/sheet.hpp"

namespace hogline::vision {

/// One painted curve. Circles are edges; lines have a width and are seen as their middle, or as two edges near by.
struct PaintedFeature {
  enum class Shape { circle, across, down_ice };
  enum class Place { fixed, left_sideline, right_sideline };

  std::string name;
  Shape shape = Shape::circle;
  Place place = Place::fixed;
  double at_m = 0.0;     ///< radius of a circle, y of a line across, x of one down-ice (of its middle)
  double width_m = 0.0;  ///< of the paint; 0: an edge
  double begin_m = 0.0;  ///< along the curve: angle of a circle (rad), x of a line across, y of one down-ice
  double end_m = 0.0;
  bool coarse = false;  ///< strong enough to be looked for far from where it is expected
};

/// Circles, lines across and the centre line, without sidelines; lines across reach as far as the narrowest sheet.
std::vector<PaintedFeature> fixed_features();

/// The two sidelines' inner edges for a sheet of this width.
PaintedFeature sideline(PaintedFeature::Place place, double width_m);

/// A point of the feature, the direction of growing parameter there, and the direction across, in e.
struct CurvePoint {
  Eigen::Vector2d at;
  Eigen::Vector2d tangent;  ///< d(at)/d(parameter)
  Eigen::Vector2d across;   ///< unit; outward of a circle, +y of a line across, +x of one down-ice
};
CurvePoint point_on(const PaintedFeature& feature, double parameter);

/// From `point` to the nearest point of the feature's infinite continuation (its edge or its middle).
Eigen::Vector2d towards(const PaintedFeature& feature, const Eigen::Vector2d& point);

}  // namespace hogline::vision
