// What a look through the far camera yields: the stones down the sheet in the end's frame e, and how the head turned
// out to look. Plain structs: the skip's controllers see no more of vision than these.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "vision/percepts/stamp.hpp"
#include "vision/percepts/stones.hpp"

namespace hogline {

/// How the camera is turned against where the plan (body, head angles, mount) puts it: the plan's pose turned by these
/// about b's axes. Pan is counter-clockwise positive, positive tilt looks down more, positive roll turns the camera's
/// right side down.
struct FarCorrection {
  double pan_rad = 0.0;
  double tilt_rad = 0.0;
  double roll_rad = 0.0;
  double pan_sigma_rad = 0.0;  ///< one standard deviation each, of what the picture and the priors say together
  double tilt_sigma_rad = 0.0;
  double roll_sigma_rad = 0.0;
};

/// Where a stone is thought to be when the picture is taken: a tracker's prediction.
struct FarExpectation {
  double x_m = 0.0;  ///< centre, in e
  double y_m = 0.0;
  PlaceCovariance covariance;
};

/// `ok == false` means that nothing can be said of any stone, with the reason (the picture does not tell where the
/// camera looks, or is no picture of this camera); an empty sheet is ok.
struct FarPercept {
  bool ok = false;
  std::string reason;  ///< why not, when !ok; empty otherwise
  Stamp stamp{};       ///< middle of the exposure

  /// Each stone's covariance is of this look alone: what all stones of the picture share comes on top, and is said by
  /// `camera` and `correction` (a tilt moves a stone by range^2 / height for each radian, along the ray).
  std::vector<StoneSighting> stones;
  FarCorrection correction;                ///< from what the picture shows of the sheet; valid when ok
  std::array<double, 16> eMc{};            ///< the corrected pose of the camera in e, row by row; valid when ok
  std::array<double, 3> camera_sigma_m{};  ///< of its place in e: x, y, z, as after the fit
  double residual_px = 0.0;                ///< RMS of the used residuals of painted lines
  int sites_used = 0;                      ///< places on painted lines that the correction rests on
  int sites_tried = 0;
  std::vector<std::string> features;  ///< what it rests on: "centre_line", "far_hog_line", "outer_ring" (far house) ...

  int candidates = 0;  ///< places in the picture that were asked whether they are a stone
  int refused = 0;     ///< of those, how many turned out to be something else
};

/// The covariance of one of its stones with what all stones of the picture share.
PlaceCovariance whole_covariance(const FarPercept& look, const StoneSighting& stone);

}  // namespace hogline
