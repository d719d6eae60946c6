#include "vision/fit/sheet_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "vision/fit/sheet_fit_impl.hpp"

namespace hogline::vision {
namespace {

constexpr double wide_spacing_px = 24.0;
constexpr double close_look_px = 3.0;
constexpr double rough_search_px = 10.0;  // a start that needs a wider search may lead astray

constexpr double held = 1e-6;  // sigma of a parameter that is not estimated

constexpr float least_colour_agreement = 0.8F;  // cosine
constexpr double convincing_share = 0.6;

// Prior of a paint's width about what the scan saw, and of a divider's place.
constexpr double paint_sigma_m = 0.015;

// By the rules the centre line runs in the sheet's middle; measured sheets keep that to a few centimetres.
constexpr double symmetry_sigma_m = 0.02;

// A start that is wrong by `start_position_m` and `start_angle_rad` moves a middling site by about `usual_search_px`;
// near the camera it moves it further, and the search goes along.
constexpr double usual_search_px = 20.0;
constexpr double start_position_m = 0.06;
constexpr double start_angle_rad = 0.015;
constexpr double most_search_px = 70.0;

double search_of(const PlannedSite& site, double search_px) {
  const double moved = 2.0 * std::hypot(start_position_m * site.along.segment<2>(0).norm(),
                                        start_angle_rad * site.along.segment<3>(3).norm());
  return std::clamp(moved * search_px / usual_search_px, 0.5 * search_px,
                    std::max(search_px, most_search_px * search_px / usual_search_px));
}

Eigen::Matrix<double, 6, 1> start_sigma(double search_px) {
  Eigen::Matrix<double, 6, 1> sigma;
  sigma.head<3>().setConstant(start_position_m * search_px / usual_search_px);
  sigma.tail<3>().setConstant(start_angle_rad * search_px / usual_search_px);
  return sigma;
}

ParameterRow unit(int k) { return ParameterRow::Unit(k); }

}  // namespace

const SheetFitResult& SheetFit::Impl::refuse(std::string reason) {
  result.ok = false;
  result.reason = std::move(reason);
  return result;
}

std::string SheetFit::Impl::unusable(const cv::Mat& image, const SheetFitStart& start) const {
  const bool colour = image.type() == CV_8UC3;
  if (image.empty() || (!colour && image.type() != CV_8UC1)) return "the picture is not 8-bit grey or BGR";
  if (image.cols != setup.intrinsics.width_px || image.rows != setup.intrinsics.height_px) {
    return "the picture is not of the camera's size";
  }
  if (!is_finite(start.eMc) || !(start.eMc.translation().z() > 0.02)) return "no usable start";
  return {};
}

void SheetFit::Impl::clear_result() {
  result.ok = false;
  result.reason.clear();
  result.sheet_width_m.reset();
  result.sites.clear();
  result.features.clear();
  result.sites_tried = result.sites_used = result.sites_hidden = 0;
}

void SheetFit::Impl::begin(const SheetFitStart& start) {
  clear_result();
  state = FitState{};
  state.eMc = start.eMc;
  state.paint_depth_m = setup.ice.paint_depth_m;
  const bool drawn = setup.sheet.sideline == SidelineKind::line || setup.sheet.sideline == SidelineKind::bumper;
  if (!start.sheet_width_m || !drawn) return;
  for (Sideline& line : state.sidelines) {
    line.known = true;
    line.is_line = setup.sheet.sideline == SidelineKind::line;
    line.edge_m = 0.5 * *start.sheet_width_m;
  }
}

// Of the camera against its mount; positive looks down more.
double SheetFit::Impl::pitch() const {
  const Eigen::Matrix3d eRb = state.eMc.linear() * bRc.transpose();
  return std::atan2(-eRb(2, 0), std::hypot(eRb(2, 1), eRb(2, 2)));
}

double SheetFit::Impl::pitch_sigma() const {
  const Eigen::RowVector3d axis = bRc.row(1);
  return std::sqrt(std::max(0.0, axis.dot(covariance.block<3, 3>(3, 3) * axis.transpose())));
}

// What is known beforehand, about the present state.
Prior SheetFit::Impl::prior(const SheetFitStart& start) const {
  Prior p;
  const Eigen::Matrix3d eRb = state.eMc.linear() * bRc.transpose();
  const double roll = std::atan2(eRb(2, 1), eRb(2, 2));
  ParameterRow row = ParameterRow::Zero();
  const auto turn_about = [&](int axis) {
    row.setZero();
    row.segment<3>(3) = bRc.row(axis);
    return row;
  };
  if (start.roll_sigma_rad > 0.0) p.add(turn_about(0), -roll, start.roll_sigma_rad);
  if (start.pitch_sigma_rad > 0.0) p.add(turn_about(1), start.pitch_offset_rad - pitch(), start.pitch_sigma_rad);
  if (start.height_sigma_m > 0.0) {
    row.setZero();
    row.segment<3>(0) = state.eMc.linear().row(2);
    p.add(row, setup.mount.z_m - state.eMc.translation().z(), start.height_sigma_m);
  }
  // A step's own length is bounded, so that what is not seen stays where it was.
  for (int k = 0; k < 3; ++k) p.add(unit(k), 0.0, 2.0);
  for (int k = 3; k < 6; ++k) p.add(unit(k), 0.0, 0.5);
  for (int side = 0; side < 2; ++side) {
    const Sideline& line = state.sidelines[static_cast<std::size_t>(side)];
    const int edge = side == 0 ? parameter::left_edge : parameter::right_edge;
    p.add(unit(edge), 0.0, line.known ? 0.3 : held);
    p.add(unit(edge + 1), 0.0, line.known && line.is_line ? paint_sigma_m : held);
  }
  const bool both = state.sidelines[0].known && state.sidelines[1].known;
  if (both) {
    p.add(unit(parameter::left_edge) - unit(parameter::right_edge),
          state.sidelines[1].edge_m - state.sidelines[0].edge_m, symmetry_sigma_m);
  }
  if (start.sheet_width_m && both) {
    p.add(unit(parameter::left_edge) + unit(parameter::right_edge),
          *start.sheet_width_m - state.sidelines[0].edge_m - state.sidelines[1].edge_m, start.sheet_width_sigma_m);
  }
  const double depth_sigma = start.paint_depth_sigma_m > 0.0 ? start.paint_depth_sigma_m : held;
  p.add(unit(parameter::depth), setup.ice.paint_depth_m - state.paint_depth_m, depth_sigma);
  return p;
}

void SheetFit::Impl::plan(const SheetFitStart& start, double spacing_px) {
  SitePlan how;
  how.spacing_px = spacing_px;
  how.travel_m = start.travel_m;
  sites.clear();
  plan_sites(camera(), state, how, sites);
}

bool SheetFit::Impl::move_by(const ParameterVector& change) {
  if (!change.allFinite()) return false;
  const FitState next = moved(state, change);
  if (!is_finite(next.eMc) || !(next.eMc.translation().z() > 0.05)) return false;
  state = next;
  return true;
}

// From the start to within a pixel. Where much of the paint is not borne out, other draws of the consensus and a wider
// search are tried, and the best of them is kept.
bool SheetFit::Impl::arrive(const PictureLight& light, const SheetFitStart& start) {
  const int attempts = start.search_px > rough_search_px ? 5 : 1;
  double best_share = -1.0;
  FitState best;
  const FitState first = state;
  for (int k = 0; k < attempts && best_share < convincing_share; ++k) {
    state = first;
    if (!approach(light, start, k)) continue;
    refine(light, start, wide_spacing_px, close_look_px, 1);
    const double share = borne_out();
    if (share <= best_share || !move_by(step.change)) continue;
    best_share = share;
    best = state;
  }
  if (best_share < 0.0) {
    if (result.reason.empty()) refuse("the fit ran away");
    return false;
  }
  result.reason.clear();
  state = best;
  return true;
}

// The share of planned sites, weighed, that the fit rests on.
double SheetFit::Impl::borne_out() const {
  double sum = 0.0;
  for (const double w : step.weight) sum += w;
  return sites.empty() ? 0.0 : sum / static_cast<double>(sites.size());
}

bool SheetFit::Impl::approach(const PictureLight& light, const SheetFitStart& start, int attempt) {
  int looks = 0;
  const double widest_px = start.search_px * (attempt % 2 == 0 ? 1.0 : 1.4);
  for (double search_px = widest_px; search_px > close_look_px; search_px *= 0.5) {
    const std::optional<Consensus> consensus{{start_sigma(search_px), attempt}};
    if (!come_closer(light, start, search_px, looks++ < 2 ? consensus : std::nullopt)) return false;
  }
  return true;
}

bool SheetFit::Impl::come_closer(const PictureLight& light, const SheetFitStart& start, double search_px,
                                 const std::optional<Consensus>& consensus) {
  plan(start, wide_spacing_px);
  wide.clear();
  for (PlannedSite& site : sites) {
    site.search_px = search_of(site, search_px);
    wide.push_back(look_widely(light, site, site.search_px, profile));
  }
  const WideStep closer = step_widely(sites, wide, prior(start), consensus);
  if (closer.agreeing < 8) {
    refuse("too little paint was found near the start");
    return false;
  }
  if (!move_by(closer.change)) {
    refuse("the fit ran away");
    return false;
  }
  return true;
}

void SheetFit::Impl::look(const PictureLight& light, double search_px, int half_breadth) {
  found.clear();
  for (const PlannedSite& site : sites) found.push_back(look_closely(light, site, search_px, half_breadth, profile));
}

// An edge keeps its colours all along: one of other colours is a stone, a shoe, a logo or a lamp.
void SheetFit::Impl::drop_odd_colours() {
  const auto colour = [this](std::size_t i) -> Eigen::Vector3f {
    return static_cast<float>(sites[i].sense) * Eigen::Map<const Eigen::Vector3f>(found[i].colour.data());
  };
  for (int f = 0; f < paint_feature_count; ++f) {
    Eigen::Vector3f mean = Eigen::Vector3f::Zero();
    for (std::size_t i = 0; i < sites.size(); ++i) {
      if (sites[i].feature == f && found[i].found) mean += colour(i);
    }
    if (mean.isZero()) continue;
    mean.normalize();
    for (std::size_t i = 0; i < sites.size(); ++i) {
      if (sites[i].feature != f || sites[i].sense == 0 || !found[i].found) continue;
      if (mean.dot(colour(i)) < least_colour_agreement) found[i].found = false;
    }
  }
}

void SheetFit::Impl::find_sidelines(const PictureLight& light, const SheetFitStart& start) {
  if (setup.sheet.sideline == SidelineKind::none) return;
  ScanRange range{0.5 * rules::min_width_m - 0.05, 0.5 * rules::max_width_m + 0.05};
  if (start.sheet_width_m) {
    const double slack_m = 0.02 + 1.5 * start.sheet_width_sigma_m;
    range = {std::max(range.begin_m, 0.5 * *start.sheet_width_m - slack_m),
             std::min(range.end_m, 0.5 * *start.sheet_width_m + slack_m)};
  }
  const bool bumper = setup.sheet.sideline == SidelineKind::bumper;
  const SheetCamera paint = camera();
  const SheetCamera surface(lens, state.eMc, Ice{0.0, setup.ice.refractive_index});
  for (int side = 0; side < 2; ++side) {
    Sideline& line = state.sidelines[static_cast<std::size_t>(side)];
    const Sideline scanned = scan_sideline(light, bumper ? surface : paint, side == 0 ? -1.0 : 1.0, !bumper, range);
    if (scanned.known || !line.known) line = scanned;
    line.moves_camera = setup.sheet.sideline != SidelineKind::unknown;
  }
}

// The sideline of that side is not planned, or most of its sites fit.
bool SheetFit::Impl::sideline_borne_out(int side) const {
  double planned = 0.0;
  double agreed = 0.0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (sites[i].feature != left_sideline_feature + side) continue;
    planned += 1.0;
    agreed += step.weight[i];
  }
  return agreed >= 0.6 * planned;
}

void SheetFit::Impl::refine(const PictureLight& light, const SheetFitStart& start, double spacing_px, double search_px,
                            int half_breadth) {
  plan(start, spacing_px);
  look(light, search_px, half_breadth);
  drop_odd_colours();
  step_closely(sites, found, prior(start), step, scratch);
}

const SheetFitResult& SheetFit::Impl::fit(const cv::Mat& image, const SheetFitStart& start) {
  begin(start);
  if (std::string why = unusable(image, start); !why.empty()) return refuse(std::move(why));
  const PictureLight light{{image.data, image.cols, image.rows, image.channels(), image.step[0]}, response};

  if (!arrive(light, start)) return result;

  for (int round = 0; round < 3; ++round) {
    find_sidelines(light, start);
    refine(light, start, 18.0, 2.5, 1);
    if (!move_by(step.change)) return refuse("the fit ran away");
    if (sideline_borne_out(0) && sideline_borne_out(1)) break;
  }
  // What still does not fit is somebody else's line: it must not move the camera.
  for (int side = 0; side < 2; ++side) {
    if (!sideline_borne_out(side)) state.sidelines[static_cast<std::size_t>(side)].moves_camera = false;
  }

  refine(light, start, 12.0, 1.5, 2);
  if (!move_by(step.change)) return refuse("the fit ran away");
  judge(start);
  return result;
}

SheetFit::SheetFit(const CameraSetup& setup) : impl_(std::make_unique<Impl>(setup)) {}
SheetFit::~SheetFit() = default;
SheetFit::SheetFit(SheetFit&&) noexcept = default;
SheetFit& SheetFit::operator=(SheetFit&&) noexcept = default;

const SheetFitResult& SheetFit::fit(const cv::Mat& image, const SheetFitStart& start) {
  return impl_->fit(image, start);
}

}  // namespace hogline::vision
