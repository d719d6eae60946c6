// Fills a NearViewSketch: what was seen, back in the raw picture's pixels.
#pragma once

#include <optional>

#include "vision/detect/line_classes.hpp"
#include "vision/near_view.hpp"

namespace hogline::vision {

void draw_candidates(const LineClasses& classes, const GroundView& view, NearViewSketch& sketch);
void draw_model(const Pose& eMc, const CameraSetup& setup, std::optional<double> width_m, NearViewSketch& sketch);

/// The painted sheet of `eMc` as poly-lines in the picture, cut at its border.
std::vector<std::vector<Eigen::Vector2d>> model_lines(const Pose& eMc, const CameraSetup& setup,
                                                      std::optional<double> width_m);

}  // namespace hogline::vision
