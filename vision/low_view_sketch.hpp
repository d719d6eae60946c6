// Fills a LowViewSketch: what was seen, back in the raw picture's pixels.
#pragma once

#include "vision/detect/h_choice.hpp"
#include "vision/low_view.hpp"

namespace hogline::vision {

void draw_candidates(const std::vector<CrossCandidate>& hog_lines, const std::vector<ClassifiedLine>& down_ice,
                     const GroundView& view, LowViewSketch& sketch);
void draw_chosen(const HShape& h, const GroundView& view, LowViewSketch& sketch);

}  // namespace hogline::vision
