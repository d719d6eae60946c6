// What a fit says of itself when it is done: place, sigmas, width, sites, and whether it may be believed.
#include "vision/fit/sheet_fit_impl.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace hogline::vision {
namespace {

// Limits beyond which an estimate tells nothing: the fit is then "not determined".
constexpr double most_sigma_yaw_rad = 1.0 * std::numbers::pi / 180.0;
constexpr double most_residual_px = 1.5;
constexpr double least_share = 0.4;  // of the places looked at
// Error common to a whole feature, which its residuals do not show: compression and colour interpolation move what is
// seen by about 0.01 px all over a picture (measured on rendered scenes), and a good calibration of the lens leaves as
// much. The mount's own error is not in it: it is constant, and part of no picture.
constexpr double shared_error_px = 0.015;
// A divider's shade and mirror image move both its feet the same way: measured 3 to 5 mm of width from 2 m above.
constexpr double foot_sigma_m = 0.004;
// Of the whole sheet's paint against the rules' numbers, which no residual shows.
constexpr double painted_sigma_m = 0.0003;

// Somebody who stands before the paint hides whole pieces of the picture: of what lies within a piece this wide, all or
// nothing is seen. A wrong pose is borne out here and there.
constexpr int piece_px = 120;
constexpr double hidden_share = 0.15;
// Where more is hidden than seen, what is seen must be much and fit well.
constexpr double most_residual_half_hidden_px = 0.6;
constexpr int least_sites_half_hidden = 150;

constexpr double unknown_bleed_px = 1.0;
constexpr double bleed_inflation = 1.5;  // neighbouring sites share their errors

}  // namespace

void SheetFit::Impl::find_hidden() {
  const int across = setup.intrinsics.width_px / piece_px + 1;
  const int down = setup.intrinsics.height_px / piece_px + 1;
  const auto number = [&](const PlannedSite& site) {
    const int i = std::clamp(static_cast<int>(site.pixel.x()) / piece_px, 0, across - 1);
    const int j = std::clamp(static_cast<int>(site.pixel.y()) / piece_px, 0, down - 1);
    return static_cast<std::size_t>(j * across + i);
  };
  pieces.assign(static_cast<std::size_t>(across * down), {});
  for (std::size_t i = 0; i < sites.size(); ++i) {
    SeenPiece& piece = pieces[number(sites[i])];
    ++piece.tried;
    piece.used += step.weight[i] > 0.0 ? 1 : 0;
  }
  hidden.clear();
  for (const PlannedSite& site : sites) {
    const SeenPiece& piece = pieces[number(site)];
    hidden.push_back(piece.used <= hidden_share * piece.tried);
  }
}

void SheetFit::Impl::report_width() {
  std::array<int, 2> used{};
  std::array<int, 2> seen{};
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (sites[i].feature < left_sideline_feature) continue;
    const auto side = static_cast<std::size_t>(sites[i].feature - left_sideline_feature);
    used[side] += step.weight[i] > 0.0 ? 1 : 0;
    seen[side] += found[i].found ? 1 : 0;
  }
  for (std::size_t side = 0; side < 2; ++side) {
    const double least = state.sidelines[side].moves_camera ? 0.4 : 0.8;
    if (!state.sidelines[side].known || used[side] < 8 || used[side] < least * seen[side]) return;
  }
  result.sheet_width_m = state.sidelines[0].edge_m + state.sidelines[1].edge_m;
  const double variance = covariance(parameter::left_edge, parameter::left_edge) +
                          covariance(parameter::right_edge, parameter::right_edge) +
                          2.0 * covariance(parameter::left_edge, parameter::right_edge);
  const double feet_m = setup.sheet.sideline == SidelineKind::line ? 0.0 : foot_sigma_m;
  result.sheet_width_sigma_m = std::hypot(std::sqrt(std::max(variance, 0.0)), feet_m);
}

// One more parameter beside the fit's, solved for afterwards: edges moved towards their darker side by the same length.
void SheetFit::Impl::report_bleed() {
  result.bleed_px = result.bleed_y_m = 0.0;
  result.bleed_sigma_px = unknown_bleed_px;
  ParameterVector by_parameters = ParameterVector::Zero();
  double own = 0.0;
  double pull = 0.0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (!sites[i].step || step.weight[i] <= 0.0) continue;
    const double lighter = std::copysign(1.0, Eigen::Map<const Eigen::Vector3f>(found[i].colour.data()).sum());
    const double spread = step.scale * step.spread_px[i];
    const double w = step.weight[i] / (spread * spread);
    by_parameters -= w * lighter * sites[i].along.transpose();
    own += w;
    pull -= w * lighter * step.residual_px[i];
  }
  const ParameterVector turned = step.information.ldlt().solve(by_parameters);
  const double told = own - by_parameters.dot(turned);
  if (!(told > 1.0 / (unknown_bleed_px * unknown_bleed_px))) return;
  result.bleed_px = pull / told;
  result.bleed_sigma_px = std::hypot(shared_error_px, bleed_inflation / std::sqrt(told));
  result.bleed_y_m = -body_by_twist().row(1).dot(turned.head<6>()) * result.bleed_px;
}

void SheetFit::Impl::report_sites() {
  const auto& features = paint_features();
  std::array<int, paint_feature_count> place{};
  place.fill(-1);
  double square = 0.0;
  double weights = 0.0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const auto f = static_cast<std::size_t>(sites[i].feature);
    if (place[f] < 0) {
      place[f] = static_cast<int>(result.features.size());
      result.features.push_back({std::string(features[f].name), 0, 0, 0});
    }
    FittedFeature& feature = result.features[static_cast<std::size_t>(place[f])];
    const bool used = step.weight[i] > 0.0;
    ++feature.sites_tried;
    feature.sites_used += used ? 1 : 0;
    const bool out_of_sight = hidden[i] && !used;
    feature.sites_hidden += out_of_sight ? 1 : 0;
    result.sites_hidden += out_of_sight ? 1 : 0;
    result.sites.push_back(
        {sites[i].pixel, sites[i].normal, step.residual_px[i], used ? step.weight[i] : 0.0, place[f]});
    square += step.weight[i] * step.residual_px[i] * step.residual_px[i];
    weights += step.weight[i];
    result.sites_used += used ? 1 : 0;
  }
  result.sites_tried = static_cast<int>(sites.size());
  result.residual_px = weights > 0.0 ? std::sqrt(square / weights) : 0.0;
}

// x, y and yaw of the body by the camera's twist: turning about the camera moves the body about it.
Eigen::Matrix<double, 3, 6> SheetFit::Impl::body_by_twist() const {
  const Eigen::Matrix3d eRc = state.eMc.linear();
  Eigen::Matrix<double, 3, 6> by_twist = Eigen::Matrix<double, 3, 6>::Zero();
  const Eigen::Matrix3d eRb = eRc * bRc.transpose();
  const double forward2 = eRb(0, 0) * eRb(0, 0) + eRb(1, 0) * eRb(1, 0);
  const Eigen::RowVector3d yaw_by_turn =
      (Eigen::RowVector3d(0.0, 0.0, 1.0) - eRb(2, 0) / forward2 * Eigen::RowVector3d(eRb(0, 0), eRb(1, 0), 0.0)) * eRc;
  by_twist.block<2, 3>(0, 0) = eRc.topRows<2>();
  by_twist.block<1, 3>(2, 3) = yaw_by_turn;
  const double yaw_rad = planar_body(state.eMc, setup.mount).yaw_rad;
  const double c = std::cos(yaw_rad);
  const double s = std::sin(yaw_rad);
  by_twist.block<1, 3>(0, 3) = (c * setup.mount.x_m - s * setup.mount.y_m) * yaw_by_turn;
  by_twist.block<1, 3>(1, 3) = (s * setup.mount.x_m + c * setup.mount.y_m) * yaw_by_turn;
  return by_twist;
}

void SheetFit::Impl::judge(const SheetFitStart& start) {
  covariance = covariance_of(sites, step, prior(start), shared_error_px);
  result.eMc = state.eMc;
  result.covariance = covariance.topLeftCorner<6, 6>();
  result.body = planar_body(state.eMc, setup.mount);
  result.paint_depth_m = state.paint_depth_m;

  const Eigen::Matrix<double, 3, 6> by_twist = body_by_twist();
  const Eigen::Matrix3d planar = by_twist * result.covariance * by_twist.transpose();
  result.sigma = {std::hypot(std::sqrt(planar(0, 0)), painted_sigma_m),
                  std::hypot(std::sqrt(planar(1, 1)), painted_sigma_m), std::sqrt(planar(2, 2))};
  result.hog_distance_sigma_m = result.sigma.y_m;
  report_width();
  report_bleed();
  find_hidden();
  report_sites();

  result.reason = refusal(start);
  result.ok = result.reason.empty();
}

std::string SheetFit::Impl::refusal(const SheetFitStart& start) const {
  if (!covariance.allFinite()) return "the fit is not determined";
  if (result.sites_used < 12) return "too few places of paint were found";
  const bool half_hidden = result.sites_used < least_share * result.sites_tried;
  const int in_sight = result.sites_tried - (start.may_be_hidden ? result.sites_hidden : 0);
  if (result.sites_used < least_share * in_sight) return "most of the paint is not where the fit puts it";
  if (half_hidden && result.sites_used < least_sites_half_hidden) return "most of the paint is hidden";
  if (result.residual_px > (half_hidden ? most_residual_half_hidden_px : most_residual_px)) {
    return "what was found does not fit a sheet";
  }
  if (!(result.sigma.y_m < start.most_sigma_m)) return "nothing in view tells the distance along the sheet";
  if (!(result.sigma.x_m < start.most_sigma_m) || !(result.sigma.yaw_rad < most_sigma_yaw_rad)) {
    return "nothing in view tells the place across the sheet or the direction";
  }
  return {};
}

}  // namespace hogline::vision
