#include "src/standing_still.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace hogline {
namespace {

constexpr double rocks_m = 0.02;
constexpr double rocks_rad = 0.1 * std::numbers::pi / 180.0;
constexpr double sigmas = 6.0;

}  // namespace

std::string StandingStill::contradiction(const std::string& name, const SheetPosePercept& sheet) {
  if (!first_) first_ = First{name, sheet.body, sheet.sigma};
  const double way_m = std::hypot(sheet.body.x_m - first_->body.x_m, sheet.body.y_m - first_->body.y_m);
  const double turn_rad = std::abs(std::remainder(sheet.body.yaw_rad - first_->body.yaw_rad, 2.0 * std::numbers::pi));
  const double way_sigma_m =
      std::hypot(std::hypot(sheet.sigma.x_m, sheet.sigma.y_m), std::hypot(first_->sigma.x_m, first_->sigma.y_m));
  const double turn_sigma_rad = std::hypot(sheet.sigma.yaw_rad, first_->sigma.yaw_rad);
  if (way_m <= rocks_m + sigmas * way_sigma_m && turn_rad <= rocks_rad + sigmas * turn_sigma_rad) return {};
  return fmt::format(
      "not of one robot that stands still: in {} it stands {:.2f} m and {:.1f} deg from where {} has it; give each "
      "place "
      "a call of its own",
      name, way_m, turn_rad * 180.0 / std::numbers::pi, first_->name);
}

}  // namespace hogline
