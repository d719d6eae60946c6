// Competitor: ViSP's plain trackers, one vpMeLine for each line and one vpMeEllipse for the outer ring, and vpPose from
// the points where they cross.
#pragma once

#include <memory>
#include <vector>

#include "tests/bench/method.hpp"

namespace hogline::bench {

/// Lines across the sheet and lines along it: their crossings are points whose place is known. With `ring_radius_m` a
/// circle about e's origin is tracked too, which adds its crossings with the lines through its centre.
struct CrossingLines {
  std::vector<PaintedLine> across;
  std::vector<PaintedLine> along;
  double ring_radius_m = 0.0;  ///< 0: none
};

std::unique_ptr<Method> make_visp_lines(const Camera& camera, const CrossingLines& lines);

}  // namespace hogline::bench
