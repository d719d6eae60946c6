// What a look at the sheet yields: the body's planar pose in the end's frame e, with its diagnosis.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "vision/percepts/stamp.hpp"

namespace hogline {

/// The body as a planar body in the end's frame `e`: origin at the tee of the house in front of the robot, y away from
/// the robot, x to the right looking along y. Yaw is the angle from e's y axis to b's x axis, counter-clockwise
/// positive.
struct PlanarPose {
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;
};

/// One standard deviation of each part of a PlanarPose.
struct PlanarSigma {
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;
};

/// The sheet's pose seen by the near or the low camera. `ok == false` means "not seen", with the reason: that is data,
/// not an error; then every estimate below is meaningless and must not be used.
struct SheetPosePercept {
  bool ok = false;
  std::string reason;           ///< why not, when !ok; empty otherwise
  Stamp stamp{};                ///< middle of the exposure
  PlanarPose body;              ///< e to b
  PlanarSigma sigma;            ///< standard deviations, from the fit and what its model cannot know
  double hog_distance_m = 0.0;  ///< from b's origin along e's y to the hog line's house-side edge
  double hog_distance_sigma_m = 0.0;
  std::optional<double> sheet_width_m;  ///< between the sidelines' inner edges; empty where they were not seen
  std::array<double, 16> eMc{};         ///< camera pose in e, row by row; valid when ok
  double residual_px = 0.0;             ///< RMS of the used residuals, normal to the painted edge
  int sites_used = 0;                   ///< edge sites the estimate rests on
  int sites_tried = 0;                  ///< edge sites looked for
  std::vector<std::string> features;    ///< what it rests on: "outer_ring", "hog_line", "left_sideline", ...
};

}  // namespace hogline
