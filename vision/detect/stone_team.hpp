// Whose a stone is: by the hue of its handle against white ice.
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "vision/detect/ice_light.hpp"
#include "vision/geometry/stone_shape.hpp"
#include "vision/percepts/stones.hpp"

namespace hogline::vision {

/// What the two teams' handles look like: hues on the colour circle, red 0, yellow 60, green 120, blue 240 degrees.
struct TeamHues {
  double first_rad = 0.0;
  double second_rad = 0.82;  ///< 47 degrees, the yellow of handles
};

/// The handle's colour against white ice (red, green, blue): the median over what of the plate no grip hides. Nothing
/// where the plate is not in the picture.
std::optional<std::array<float, 3>> handle_colour(const cv::Mat& bgr, const Eigen::Vector2d& place,
                                                  const SheetCamera& camera, const StoneShape& shape,
                                                  const IceLight& ice, const ResponseCurve& response);

struct TeamVerdict {
  Team team = Team::unknown;
  double confidence = 0.0;
};

/// The nearer of the two hues, unless it is not near, or the handle has no colour.
TeamVerdict team_of(const std::array<float, 3>& colour, const TeamHues& hues);

}  // namespace hogline::vision
