#include "vision/far_view/far_sheet.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "vision/fit/sideline_scan.hpp"
#include "vision/geometry/sheet.hpp"

namespace hogline::vision {
namespace {

constexpr double held = 1e-6;  // sigma of a parameter that is not estimated
constexpr double paint_sigma_m = 0.015;
constexpr double symmetry_sigma_m = 0.02;  // of the sidelines about the centre line, see SheetFit
constexpr double vote_spacing_px = 40.0;
constexpr double vote_blur_px = 4.0;
// Following from picture to picture.
constexpr double followed_places = 80.0;
constexpr double least_spacing_px = 32.0;
constexpr double follow_search_px = 3.5;
constexpr double rough_floor_px = 0.8;
constexpr double shared_error_px = 0.015;  // common to a feature, see SheetFit
constexpr double across_half_width_m = 2.1;

// Rows of the sheet in which sidelines are looked for, beyond the camera.
constexpr double first_row_m = 7.0;
constexpr double row_step_m = 0.45;
constexpr double scan_margin_m = 0.03;

// Limits beyond which a correction is none.
constexpr int least_sites = 12;
constexpr double most_residual_px = 1.2;
constexpr double least_share = 0.4;           // of the places looked at
constexpr double most_tilt_sigma_rad = 6e-4;  // 0.3 m at 30 m
constexpr double most_pan_sigma_rad = 5e-3;   // 0.15 m at 30 m
constexpr double most_sigmas = 4.0;           // of the plan
constexpr int clear_sites = 8;                // so many places of a line seen elsewhere are no chance
constexpr double least_vote = 0.25;

ParameterRow unit(int k) { return ParameterRow::Unit(k); }

}  // namespace

Pose corrected(const Pose& eMc, const FarCorrection& c) {
  const Eigen::Vector3d turn = head_axes(eMc) * Eigen::Vector3d(c.roll_rad, c.tilt_rad, c.pan_rad);
  Pose pose = eMc;
  if (turn.norm() > 0.0) pose.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * eMc.linear();
  return pose;
}

FarSheet::FarSheet(const CameraSetup& setup) : setup_(setup), lens_(setup.intrinsics) {}

const FarAim& FarSheet::refuse(std::string reason) {
  aim_.ok = false;
  aim_.reason = std::move(reason);
  return aim_;
}

void FarSheet::begin(const FarPlan& plan) {
  plan_ = plan;
  aim_ = FarAim{};
  state_ = FitState{};
  state_.eMc = plan.eMc;
  state_.paint_depth_m = setup_.ice.paint_depth_m;
}

// Roll, tilt and pan of the present state against the plan.
Eigen::Vector3d FarSheet::turned() const {
  const Eigen::AngleAxisd turn(state_.eMc.linear() * plan_.eMc.linear().transpose());
  return head_axes(plan_.eMc).transpose() * (turn.angle() * turn.axis());
}

Prior FarSheet::prior() const {
  Prior p;
  const Eigen::Matrix3d eRc = state_.eMc.linear();
  const Eigen::Vector3d off = plan_.eMc.translation() - state_.eMc.translation();
  const Eigen::Vector3d turn = turned();
  const Eigen::Matrix3d axes = head_axes(plan_.eMc);
  const std::array<double, 3> place_sigma{plan_.place_sigma_m, plan_.place_sigma_m, plan_.height_sigma_m};
  const std::array<double, 3> turn_sigma{plan_.roll_sigma_rad, plan_.tilt_sigma_rad, plan_.pan_sigma_rad};
  for (int k = 0; k < 3; ++k) {
    ParameterRow row = ParameterRow::Zero();
    row.segment<3>(0) = eRc.row(k);
    p.add(row, off[k], place_sigma[static_cast<std::size_t>(k)]);
    row.setZero();
    row.segment<3>(3) = axes.col(k).transpose() * eRc;
    p.add(row, -turn[k], turn_sigma[static_cast<std::size_t>(k)]);
  }
  for (int side = 0; side < 2; ++side) {
    const Sideline& line = state_.sidelines[static_cast<std::size_t>(side)];
    const int edge = side == 0 ? parameter::left_edge : parameter::right_edge;
    p.add(unit(edge), 0.0, line.known ? 0.3 : held);
    p.add(unit(edge + 1), 0.0, line.known && line.is_line ? paint_sigma_m : held);
    if (plan_.sheet_width_m && line.known) {
      p.add(unit(edge), 0.5 * *plan_.sheet_width_m - line.edge_m,
            std::hypot(symmetry_sigma_m, plan_.sheet_width_sigma_m));
    }
  }
  if (state_.sidelines[0].known && state_.sidelines[1].known) {
    p.add(unit(parameter::left_edge) - unit(parameter::right_edge),
          state_.sidelines[1].edge_m - state_.sidelines[0].edge_m, symmetry_sigma_m);
  }
  const double depth_sigma = setup_.paint_depth_sigma_m > 0.0 ? setup_.paint_depth_sigma_m : held;
  p.add(unit(parameter::depth), setup_.ice.paint_depth_m - state_.paint_depth_m, depth_sigma);
  return p;
}

bool FarSheet::vote(const PictureLight& light) {
  sites_.clear();
  const SheetCamera camera(lens_, state_.eMc, setup_.ice);
  // With so much blur even a near hog line is one dark band, not two edges.
  plan_sites(camera, state_,
             {.spacing_px = vote_spacing_px, .optical_blur_px = vote_blur_px, .half_width_m = across_half_width_m},
             sites_);
  const LineVote vote = voter_.find(light, plan_.eMc, sites_, {plan_.pan_sigma_rad, plan_.tilt_sigma_rad});
  if (vote.agreement < least_vote) return false;
  state_.eMc = corrected(plan_.eMc, {.pan_rad = vote.pan_rad, .tilt_rad = vote.tilt_rad});
  return true;
}

void FarSheet::find_sidelines(const PictureLight& light) {
  if (setup_.sheet.sideline == SidelineKind::none) return;
  ScanRange range{0.5 * rules::min_width_m - scan_margin_m, 0.5 * rules::max_width_m + scan_margin_m, first_row_m,
                  row_step_m};
  if (plan_.sheet_width_m) {
    const double slack_m = 2.0 * std::hypot(symmetry_sigma_m, plan_.sheet_width_sigma_m);
    range.begin_m = std::max(range.begin_m, 0.5 * *plan_.sheet_width_m - slack_m);
    range.end_m = std::min(range.end_m, 0.5 * *plan_.sheet_width_m + slack_m);
  }
  const bool as_line = setup_.sheet.sideline != SidelineKind::bumper;
  const Ice ice{as_line ? setup_.ice.paint_depth_m : 0.0, setup_.ice.refractive_index};
  const SheetCamera camera(lens_, state_.eMc, ice);
  for (int side = 0; side < 2; ++side) {
    Sideline& line = state_.sidelines[static_cast<std::size_t>(side)];
    line = scan_sideline(light, camera, side == 0 ? -1.0 : 1.0, as_line, range);
    line.moves_camera = setup_.sheet.sideline != SidelineKind::unknown;
  }
}

void FarSheet::look(const PictureLight& light, const Round& round) {
  sites_.clear();
  const SheetCamera camera(lens_, state_.eMc, Ice{state_.paint_depth_m, setup_.ice.refractive_index});
  plan_sites(camera, state_, {.spacing_px = round.spacing_px, .half_width_m = across_half_width_m}, sites_);
  found_.clear();
  own_floor_px_.clear();
  for (const PlannedSite& site : sites_) {
    own_floor_px_.push_back(site.floor_px);
    found_.push_back(look_closely(light, site, round.search_px, round.half_breadth, profile_));
  }
}

void FarSheet::solve(double floor_px, const ParameterVector& start) {
  for (std::size_t i = 0; i < sites_.size(); ++i) sites_[i].floor_px = std::max(own_floor_px_[i], floor_px);
  step_closely(sites_, found_, prior(), step_, scratch_, start);
}

bool FarSheet::move() {
  if (!step_.change.allFinite()) return false;
  const FitState next = moved(state_, step_.change);
  if (!is_finite(next.eMc) || !(next.eMc.translation().z() > 0.05)) return false;
  state_ = next;
  return true;
}

// Plans, looks and takes one robust step.
bool FarSheet::settle(const PictureLight& light, const Round& round) {
  look(light, round);
  solve(round.floor_px, ParameterVector::Zero());
  return move();
}

const FarAim& FarSheet::find(const PictureLight& light, const FarPlan& plan) {
  begin(plan);
  if (!vote(light)) return refuse("none of the sheet's lines is seen near where the plan puts it");

  for (const Round& round : {Round{48.0, 6.0, 2, 1.5}, Round{40.0, 3.0, 2, 0.5}}) {
    if (!settle(light, round)) return refuse("the fit ran away");
  }
  find_sidelines(light);
  for (const Round& round : {Round{40.0, 2.5, 2, 0.3}, Round{24.0, 1.5, 2, 0.0}}) {
    if (!settle(light, round)) return refuse("the fit ran away");
  }
  return judge();
}

// One look, solved twice: roughly, so that no line is taken for somebody else's, then with each place's own error.
const FarAim& FarSheet::follow(const PictureLight& light, const FarPlan& plan) {
  const FitState before = state_;
  begin(plan);
  state_.sidelines = before.sidelines;
  look(light, {std::max(spacing_px_, least_spacing_px), follow_search_px, 1, 0.0});
  spacing_px_ = std::max(spacing_px_, least_spacing_px) * static_cast<double>(sites_.size()) / followed_places;
  solve(rough_floor_px, ParameterVector::Zero());
  const ParameterVector rough = step_.change;
  if (!rough.allFinite()) return refuse("the fit ran away");
  solve(0.0, rough);
  if (!move()) return refuse("the fit ran away");
  return judge();
}

const FarAim& FarSheet::judge() {
  const Eigen::Matrix3d eRc = state_.eMc.linear();
  Eigen::Matrix<double, 6, 6> in_e = Eigen::Matrix<double, 6, 6>::Zero();
  in_e.topLeftCorner<3, 3>() = in_e.bottomRightCorner<3, 3>() = eRc;
  const ParameterMatrix covariance = covariance_of(sites_, step_, prior(), shared_error_px);
  aim_.covariance = in_e * covariance.topLeftCorner<6, 6>() * in_e.transpose();
  aim_.eMc = state_.eMc;
  aim_.sidelines = state_.sidelines;

  const Eigen::Vector3d turn = turned();
  const Eigen::Matrix3d axes = head_axes(plan_.eMc);
  const Eigen::Matrix3d turn_covariance = axes.transpose() * aim_.covariance.bottomRightCorner<3, 3>() * axes;
  aim_.correction = {turn[2],
                     turn[1],
                     turn[0],
                     std::sqrt(turn_covariance(2, 2)),
                     std::sqrt(turn_covariance(1, 1)),
                     std::sqrt(turn_covariance(0, 0))};

  double square = 0.0;
  double weights = 0.0;
  std::array<int, paint_feature_count> used{};
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    square += step_.weight[i] * step_.residual_px[i] * step_.residual_px[i];
    weights += step_.weight[i];
    used[static_cast<std::size_t>(sites_[i].feature)] += step_.weight[i] > 0.0 ? 1 : 0;
  }
  aim_.residual_px = weights > 0.0 ? std::sqrt(square / weights) : 0.0;
  aim_.sites_tried = static_cast<int>(sites_.size());
  aim_.sites_used = 0;
  for (std::size_t f = 0; f < used.size(); ++f) {
    aim_.sites_used += used[f];
    if (used[f] >= 3) aim_.features.emplace_back(paint_features()[f].name);
  }
  aim_.reason = refusal();
  aim_.ok = aim_.reason.empty();
  return aim_;
}

// A line that is clearly seen, but not where all the others put it.
std::string FarSheet::contradiction() const {
  std::array<int, paint_feature_count> seen{};
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    seen[static_cast<std::size_t>(sites_[i].feature)] += found_[i].found ? 1 : 0;
  }
  for (std::size_t f = 0; f < seen.size(); ++f) {
    const PaintFeature& feature = paint_features()[f];
    const bool certain = feature.shape == PaintShape::across || feature.shape == PaintShape::centre_line;
    if (certain && step_.dropped[f] && seen[f] >= clear_sites) return std::string(feature.name);
  }
  return {};
}

std::string FarSheet::refusal() const {
  if (!aim_.covariance.allFinite() || !is_finite(aim_.eMc)) return "the fit is not determined";
  if (aim_.sites_used < least_sites) return "too few places of painted lines were found";
  if (aim_.sites_used < least_share * aim_.sites_tried) return "most of the paint is not where the fit puts it";
  if (const std::string line = contradiction(); !line.empty()) {
    return "the " + line + " is not where the plan and the other lines put it";
  }
  if (aim_.residual_px > most_residual_px) return "what was found does not fit a sheet";
  if (!(aim_.correction.tilt_sigma_rad < most_tilt_sigma_rad)) return "nothing in view tells the tilt";
  if (!(aim_.correction.pan_sigma_rad < most_pan_sigma_rad)) return "nothing in view tells the pan";
  const Eigen::Vector3d off = aim_.eMc.translation() - plan_.eMc.translation();
  if (std::abs(aim_.correction.tilt_rad) > most_sigmas * plan_.tilt_sigma_rad ||
      std::abs(aim_.correction.pan_rad) > most_sigmas * plan_.pan_sigma_rad ||
      std::abs(aim_.correction.roll_rad) > most_sigmas * plan_.roll_sigma_rad) {
    return "the lines are seen too far from where the plan puts them";
  }
  if (off.head<2>().norm() > most_sigmas * plan_.place_sigma_m ||
      std::abs(off.z()) > most_sigmas * plan_.height_sigma_m) {
    return "the lines do not fit the place that the plan gives the camera";
  }
  return {};
}

}  // namespace hogline::vision
