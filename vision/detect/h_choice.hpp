// The H: the hog line and what runs down-ice, chosen together (section III.B and figure 5 of the paper). Three terms:
// the gaps between the hog line's ends and the two sidelines, and the difference between their intercepts' spacing and
// the sheet's width. Where a sideline is missing, the centre line and the other sideline carry the H.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vision/detect/h_lines.hpp"
#include "vision/detect/line_classes.hpp"

namespace hogline::vision {

struct HShape {
  CrossCandidate hog;
  std::optional<ClassifiedLine> left;
  std::optional<ClassifiedLine> right;
  std::optional<ClassifiedLine> centre;
  double error_m = 0.0;           ///< the three terms, in metres; what is missing costs
  PlanarPose body;                ///< from the intercepts
  std::optional<double> width_m;  ///< from the intercepts, where sidelines were seen
};

/// What is known of the sheet and the body beforehand.
struct HKnowledge {
  double width_m = rules::nominal_width_m;
  double width_sigma_m = 0.3;  ///< sheets are 4.318 to 5.0 m wide
  std::optional<PlanarPose> body;
  PlanarSigma body_sigma;
  double camera_height_m = 0.5;
};

/// The best first; empty when no hog line candidate goes with anything that runs down-ice.
std::vector<HShape> choose_h(const std::vector<CrossCandidate>& hog_lines, const std::vector<ClassifiedLine>& down_ice,
                             const HKnowledge& known);

}  // namespace hogline::vision
