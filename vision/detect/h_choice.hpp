// The H: the hog line and what runs down-ice, chosen together (section III.B and figure 5 of the paper). Three terms:
// the gaps between the hog line's ends and the two sidelines, and the difference between their intercepts' spacing and
// the sheet's width. Where a sideline is missing, the centre line and the other sideline carry the H.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vision/detect/h_level.hpp"
#include "vision/detect/h_lines.hpp"
#include "vision/detect/line_classes.hpp"

namespace hogline::vision {

struct HShape {
  CrossCandidate hog;
  std::optional<ClassifiedLine> left;
  std::optional<ClassifiedLine> right;
  std::optional<ClassifiedLine> centre;
  double error_m = 0.0;  ///< the three terms, in metres; what is missing costs
  CentreLine centre_at;
  PlanarPose body;                ///< from the intercepts
  double lean_rad = 0.0;          ///< how much more the camera looks down than its mount says, from the down-ice lines
  std::optional<double> width_m;  ///< from the intercepts, where sidelines were seen
};

/// What is known of the sheet and the body beforehand.
struct HKnowledge {
  std::optional<double> width_m;  ///< as measured before; empty: anything from 4.318 to 5.0 m
  double width_sigma_m = 0.03;    ///< of `width_m`, where it is given
  std::optional<PlanarPose> body;
  PlanarSigma body_sigma;
};

/// The best first; empty when no hog line candidate goes with anything that runs down-ice.
std::vector<HShape> choose_h(const std::vector<CrossCandidate>& hog_lines, const std::vector<ClassifiedLine>& down_ice,
                             const HKnowledge& known, const GroundView& view);

}  // namespace hogline::vision
