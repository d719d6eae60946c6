// The painted sheet as the joint fit sees it: a list of features, and what other paint is near a place.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>

#include "vision/fit/fit_parameters.hpp"

namespace hogline::vision {

enum class PaintShape {
  ring,         ///< the outer edge of a circle about the tee
  across,       ///< a line along x
  centre_line,  ///< the line along y at x = 0
  sideline,     ///< a line along y, or a divider's foot, at a distance to be found
};

struct PaintFeature {
  std::string_view name;
  PaintShape shape;
  double begin_m;  ///< ring: radius; across: the smaller y of its edges; sideline: -1 left, 1 right
  double end_m;    ///< across: the larger y of its edges
};

/// Four rings, six lines across, centre line, left and right sideline, in this order.
inline constexpr int paint_feature_count = 13;
inline constexpr int left_sideline_feature = 11;
inline constexpr int right_sideline_feature = 12;
const std::array<PaintFeature, paint_feature_count>& paint_features();

/// A stretch of the sheet along an edge's normal: place + s * per_px, s in pixels of the picture.
struct GroundCut {
  Eigen::Vector2d place;
  Eigen::Vector2d per_px;  ///< along the normal, metres a pixel
  Eigen::Vector2d beside;  ///< along the tangent, metres a pixel
};

/// How far the cut may reach either way before it meets other paint than the feature `own`, in pixels, at most
/// `limit_px`; both are zero when the place itself is within `clear_px` of other paint. Beside the own sideline the
/// neighbouring sheet's is expected.
struct Room {
  double before_px;
  double after_px;
};
Room room_around(const GroundCut& cut, int own, const FitState& state, double clear_px, double limit_px);

}  // namespace hogline::vision
