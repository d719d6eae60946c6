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

/// How the camera is turned against where the plan (body, head angles, mount) puts it: pan about the vertical,
/// counter-clockwise positive; tilt about the level axis to the left of where it looks, positive looks down more; roll
/// about the level axis along which it looks, positive turns the camera's right side down.
struct FarCorrection {
  double pan_rad = 0.0;
  double tilt_rad = 0.0;
  double roll_rad = 0.0;
  double pan_sigma_rad = 0.0;  ///< one standard deviation each, of what the picture and the priors say together
  double tilt_sigma_rad = 0.0;
  double roll_sigma_rad = 0.0;
};

/// `ok == false` means that nothing can be said of any stone, with the reason (the picture does not tell where the
/// camera looks, or is no picture of this camera); an empty sheet is ok.
struct FarPercept {
  bool ok = false;
  std::string reason;  ///< why not, when !ok; empty otherwise
  Stamp stamp{};       ///< middle of the exposure

  /// Each stone's covariance is of this look alone. What all stones of the picture share comes on top: `covariance` of
  /// the camera, most of it `correction.tilt_sigma_rad` (a tilt moves a stone by range^2 / height for each radian).
  std::vector<StoneSighting> stones;
  FarCorrection correction;                ///< from what the picture shows of the sheet; valid when ok
  std::array<double, 16> eMc{};            ///< the corrected pose of the camera in e, row by row; valid when ok
  std::array<double, 3> camera_sigma_m{};  ///< of its place in e: x, y, z, as after the fit
  std::array<double, 36> covariance{};     ///< of its place (x, y, z) and its turn about e's axes, row by row
  double residual_px = 0.0;                ///< RMS of the used residuals of painted lines
  int sites_used = 0;                      ///< places on painted lines that the correction rests on
  int sites_tried = 0;
  std::vector<std::string> features;  ///< what it rests on: "centre_line", "far_hog_line", "outer_ring" (far house) ...

  int candidates = 0;  ///< places in the picture that were asked whether they are a stone
  int refused = 0;     ///< of those, how many turned out to be something else
};

/// The covariance of one of its stones with what all stones of the picture share: how the camera's place and turn move
/// the point of the ice that a pixel shows. `handle_height_m` is that of the stones' rims over the ice.
inline PlaceCovariance whole_covariance(const FarPercept& look, const StoneSighting& stone,
                                        double handle_height_m = 0.125) {
  const double dx = stone.x_m - look.eMc[3];
  const double dy = stone.y_m - look.eMc[7];
  const double dz = handle_height_m - look.eMc[11];
  const double a = dx / dz;
  const double b = dy / dz;
  // d(x, y) by place and turn: the ray moves, and is followed down to the plane again.
  const std::array<double, 6> by_x{1.0, 0.0, -a, -a * dy, dz + a * dx, -dy};
  const std::array<double, 6> by_y{0.0, 1.0, -b, -dz - b * dy, b * dx, dx};
  PlaceCovariance whole = stone.covariance;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      const double c = look.covariance[6 * i + j];
      whole.xx_m2 += by_x[i] * c * by_x[j];
      whole.xy_m2 += by_x[i] * c * by_y[j];
      whole.yy_m2 += by_y[i] * c * by_y[j];
    }
  }
  return whole;
}

}  // namespace hogline
