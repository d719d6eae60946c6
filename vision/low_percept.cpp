#include "vision/low_percept.hpp"

#include <algorithm>
#include <cmath>

#include "vision/fit_percept.hpp"
#include "vision/geometry/sheet.hpp"

namespace hogline::vision {
namespace {

constexpr double sideline_lean_rad = 0.0005;  // sidelines that open by 5 mm over 2 m look like so much lean
constexpr double least_error_m = 0.0005;
constexpr int enough_of_a_ring = 24;

// Without a ring the lean comes from sidelines, which are not laid as parallel as the fit takes them to be.
double lean_error_m(const SheetFitResult& result, const CameraSetup& setup) {
  const bool ring = std::any_of(result.features.begin(), result.features.end(), [](const FittedFeature& f) {
    return f.name.ends_with("_ring") && f.sites_used >= enough_of_a_ring;
  });
  if (ring) return least_error_m;
  const double z = setup.mount.z_m;
  const double ahead = rules::tee_to_hog_m - result.eMc.translation().y();
  return std::hypot(least_error_m, sideline_lean_rad * (ahead * ahead + z * z) / z);
}

// A fit that lifts the camera off its mount has been fed a wrong lens or response curve: it errs in the distance by as
// large a share as in the height.
double lifted_error_m(const Pose& eMc, const CameraSetup& setup) {
  const double lifted_m = std::abs(eMc.translation().z() - setup.mount.z_m) - low_mount::height_sigma_m;
  return std::max(0.0, lifted_m) / setup.mount.z_m * std::abs(rules::tee_to_hog_m - eMc.translation().y());
}

// With the right response curve edges bleed by hundredths of a pixel; a gamma of 1 taken for 2.2, or the other way
// round, moves them by a quarter to half of one (measured on rendered sheets).
constexpr double most_bleed_px = 0.15;
constexpr double sure_sigmas = 2.5;

// What edges that all lie to one side do to the distance; as much of it as their own sigma explains is noise.
double bleed_error_m(const SheetFitResult& result) {
  const double bleed_px = std::abs(result.bleed_px);
  if (bleed_px <= result.bleed_sigma_px) return 0.0;
  return 1.5 * std::abs(result.bleed_y_m) * (1.0 - result.bleed_sigma_px / bleed_px);
}

}  // namespace

std::string doubt_of_response(const SheetFitResult& result) {
  const double bleed_px = std::abs(result.bleed_px);
  if (bleed_px < most_bleed_px || bleed_px < sure_sigmas * result.bleed_sigma_px) return {};
  return "all edges lie too far to one side: the rig's gamma, lens or mount is not the camera's";
}

std::string doubt_of_mount(const Pose& eMc, const CameraSetup& setup) {
  const Eigen::Vector3d up = bMc(setup.mount).linear() * eMc.linear().row(2).transpose();
  if (std::abs(up.x()) > 6.0 * lean_sigma_rad || std::abs(up.y()) > 6.0 * low_mount::roll_sigma_rad) {
    return "the fitted tilt is too far from the mount's";
  }
  if (std::abs(eMc.translation().z() - setup.mount.z_m) > 4.0 * low_mount::height_sigma_m) {
    return "the fitted height is too far from the mount's";
  }
  return {};
}

void fill_low_percept(const SheetFitResult& result, const CameraSetup& setup, SheetPosePercept& percept) {
  fill_percept(result, percept);
  percept.hog_distance_sigma_m =
      std::hypot(result.hog_distance_sigma_m,
                 std::hypot(lean_error_m(result, setup), lifted_error_m(result.eMc, setup), bleed_error_m(result)));
  percept.sigma.y_m = percept.hog_distance_sigma_m;
}

}  // namespace hogline::vision
