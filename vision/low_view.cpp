#include "vision/low_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "vision/detect/edge_points.hpp"
#include "vision/detect/h_choice.hpp"
#include "vision/detect/h_level.hpp"
#include "vision/detect/h_lines.hpp"
#include "vision/detect/h_ridges.hpp"
#include "vision/detect/line_candidates.hpp"
#include "vision/detect/line_classes.hpp"
#include "vision/fit/sheet_fit.hpp"
#include "vision/hog_line_evidence.hpp"
#include "vision/low_percept.hpp"
#include "vision/low_view_sketch.hpp"
#include "vision/near_view_sketch.hpp"
#include "vision/picture/picture_shape.hpp"

namespace hogline::vision {
namespace {

constexpr double range_m = 11.0;  // of the hog line from the body
constexpr double max_yaw_rad = 0.262;
constexpr std::size_t most_lines = 40;
constexpr std::size_t most_hog_lines = 8;
constexpr std::size_t most_tries = 3;
constexpr std::array<double, 2> search_px{10.0, 20.0};  // the wider one where the first was not believed
constexpr int fewest_sideline_points = 40;
constexpr double most_sigma_m = 0.3;  // far off, without sidelines, the body's rocking leaves as much
constexpr double least_lean_sigma_rad = 0.0006;

/// A pose to start the joint fit from.
struct Start {
  PlanarPose body;
  std::optional<double> width_m;
  double lean_rad = 0.0;  ///< how much more the camera looks down than its mount says
  double lean_sigma_rad = vision::lean_sigma_rad;
};

// Edges that may run down-ice; rings, logos and lines across give most of the others.
std::vector<EdgePoint> down_ice_points(const std::vector<EdgePoint>& points) {
  constexpr double least_cosine = 0.85;
  std::vector<EdgePoint> some;
  for (const EdgePoint& p : points) {
    if (std::abs(p.ground_normal.x()) > least_cosine) some.push_back(p);
  }
  return some;
}

}  // namespace

struct LowView::Impl {
  explicit Impl(const CameraSetup& camera_setup)
      : setup(camera_setup),
        view(camera_setup),
        ridge_finder(view, range_m),
        light(ridge_finder.top()),
        response(camera_setup.gamma),
        fit(camera_setup) {}

  Start levelled(const HShape& h, const std::vector<EdgePoint>& points, std::optional<double> known_width_m) const;
  CrossRange hog_range(const LowViewPrediction& prediction) const;
  HKnowledge knowledge(const LowViewPrediction& prediction) const;
  SheetPosePercept refine(const cv::Mat& image, const Start& start, double within_px, Stamp stamp,
                          LowViewSketch* sketch);
  std::string doubt(const SheetFitResult& result, const Start& start) const;
  std::string doubt_of_line(const cv::Mat& image, const SheetFitResult& result) const;
  std::string why_no_hog_line(int too_thin) const;

  CameraSetup setup;
  GroundView view;
  HogRidgeFinder ridge_finder;
  IceLight light;
  ResponseCurve response;
  SheetFit fit;
};

LowView::LowView(const CameraSetup& setup) : impl_(std::make_unique<Impl>(setup)) {}
LowView::~LowView() = default;
LowView::LowView(LowView&&) noexcept = default;
LowView& LowView::operator=(LowView&&) noexcept = default;

SheetPosePercept LowView::acquire(const cv::Mat& image, Stamp stamp, const LowViewPrediction& prediction,
                                  LowViewSketch* sketch) {
  SheetPosePercept nothing;
  nothing.stamp = stamp;
  nothing.reason = shape_fault(image, impl_->setup.intrinsics);
  if (!nothing.reason.empty()) return nothing;

  impl_->light.read(image);
  const auto ridges = impl_->ridge_finder.find(impl_->light);
  int too_thin = 0;
  const auto hog_lines = find_cross_candidates(ridges, impl_->ridge_finder, impl_->view, impl_->hog_range(prediction),
                                               most_hog_lines, &too_thin);
  nothing.reason = impl_->why_no_hog_line(too_thin);
  if (hog_lines.empty()) return nothing;

  const auto points = find_edge_points(impl_->light.half(), impl_->light.top(), impl_->view, {.range_m = range_m});
  const auto lines = find_line_candidates(down_ice_points(points), impl_->view.pixels_per_plane_unit(), most_lines);
  const LineClasses classes = classify(lines, impl_->view, {});
  if (sketch != nullptr) draw_candidates(hog_lines, classes.down_ice, impl_->view, *sketch);

  const auto shapes = choose_h(hog_lines, classes.down_ice, impl_->knowledge(prediction), impl_->view);
  nothing.reason = "no line that runs down-ice goes with what may be the hog line";
  for (std::size_t i = 0; i < std::min(shapes.size(), most_tries); ++i) {
    const Start start = impl_->levelled(shapes[i], points, prediction.sheet_width_m);
    for (const double within_px : search_px) {
      const SheetPosePercept seen = impl_->refine(image, start, within_px, stamp, sketch);
      if (seen.ok && sketch != nullptr) draw_chosen(shapes[i], impl_->view, *sketch);
      if (seen.ok) return seen;
      if (i == 0) nothing.reason = seen.reason;
    }
  }
  return nothing;
}

const SheetFit& LowView::fit() const { return impl_->fit; }

Start LowView::Impl::levelled(const HShape& h, const std::vector<EdgePoint>& points,
                              std::optional<double> known_width_m) const {
  const auto vote = vote_for_lean(points, h.hog, h.centre_at, view);
  if (!vote) return {.body = h.body, .width_m = known_width_m ? known_width_m : h.width_m};
  Start start{.body = body_before(h.hog, h.centre_at, vote->lean_rad, view),
              .width_m = known_width_m,
              .lean_rad = vote->lean_rad,
              .lean_sigma_rad = std::clamp(vote->sigma_rad, least_lean_sigma_rad, lean_sigma_rad)};
  start.body.y_m += vote->ring_shift_m;
  if (!known_width_m && vote->sideline_points >= fewest_sideline_points) start.width_m = vote->width_m;
  return start;
}

CrossRange LowView::Impl::hog_range(const LowViewPrediction& prediction) const {
  CrossRange range{-max_yaw_rad, max_yaw_rad, 0.3, range_m};
  if (!prediction.body) return range;
  const double distance_m = rules::tee_to_hog_m - prediction.body->y_m;
  const double slack_m =
      0.1 + 4.0 * prediction.body_sigma.y_m + 3.0 * lean_sigma_rad * distance_m * distance_m / setup.mount.z_m;
  const double slack_rad = 0.02 + 4.0 * prediction.body_sigma.yaw_rad;
  range.min_distance_m = std::max(range.min_distance_m, distance_m - slack_m);
  range.max_distance_m = std::min(range.max_distance_m, distance_m + slack_m);
  range.min_yaw_rad = std::max(range.min_yaw_rad, prediction.body->yaw_rad - slack_rad);
  range.max_yaw_rad = std::min(range.max_yaw_rad, prediction.body->yaw_rad + slack_rad);
  return range;
}

HKnowledge LowView::Impl::knowledge(const LowViewPrediction& prediction) const {
  HKnowledge known;
  known.width_m = prediction.sheet_width_m;
  known.body = prediction.body;
  known.body_sigma = prediction.body_sigma;
  return known;
}

SheetPosePercept LowView::Impl::refine(const cv::Mat& image, const Start& start, double within_px, Stamp stamp,
                                       LowViewSketch* sketch) {
  SheetFitStart fit_start;
  Mount mount = setup.mount;
  mount.pitch_rad += start.lean_rad;
  fit_start.eMc = eMb(start.body) * bMc(mount);
  fit_start.search_px = within_px;
  fit_start.sheet_width_m = start.width_m;
  fit_start.most_sigma_m = most_sigma_m;
  fit_start.pitch_offset_rad = start.lean_rad;
  fit_start.pitch_sigma_rad = start.lean_sigma_rad;
  fit_start.roll_sigma_rad = low_mount::roll_sigma_rad;
  fit_start.height_sigma_m = low_mount::height_sigma_m;
  const SheetFitResult& result = fit.fit(image, fit_start);
  SheetPosePercept seen;
  seen.stamp = stamp;
  seen.reason = result.ok ? doubt(result, start) : result.reason;
  if (seen.reason.empty()) seen.reason = doubt_of_line(image, result);
  if (!seen.reason.empty()) return seen;
  if (sketch != nullptr) sketch->model = model_lines(result.eMc, setup, result.sheet_width_m);
  fill_low_percept(result, setup, seen);
  return seen;
}

// Why a fit that converged is not believed.
std::string LowView::Impl::doubt(const SheetFitResult& result, const Start& start) const {
  if (std::string why = doubt_of_response(result); !why.empty()) return why;
  if (std::string why = doubt_of_mount(result.eMc, setup); !why.empty()) return why;
  const double far_m = rules::tee_to_hog_m - start.body.y_m;
  const double slack_m = 0.05 + 4.0 * lean_sigma_rad * far_m * far_m / setup.mount.z_m;
  if (std::abs(result.body.y_m - start.body.y_m) > slack_m || std::abs(result.body.x_m - start.body.x_m) > 0.5 ||
      std::abs(result.body.yaw_rad - start.body.yaw_rad) > 0.05) {
    return "the fit went away from the H that was seen";
  }
  int others = 0;
  for (const FittedFeature& f : result.features) {
    const bool hog = f.name == "hog_line";
    if (!hog) others += f.sites_used;
    if (hog && (f.sites_used < 12 || f.sites_used < 0.3 * f.sites_tried)) {
      return "the hog line is not where the pose puts it";
    }
    if (f.name == "centre_line" && f.sites_tried >= 12 && f.sites_used < 0.4 * f.sites_tried) {
      return "the centre line is not where the pose puts it";
    }
    if (f.name.ends_with("_ring") && f.sites_tried >= 40 && f.sites_used < 0.3 * f.sites_tried) {
      return "the rings are not where the pose puts them";
    }
  }
  if (others < 12) return "nothing but the hog line is where the pose puts it";
  // Where the centre line is not there either, hog line and sidelines must be there in full.
  if (result.sites_used < 0.5 * result.sites_tried) return "less than half of the paint is where the pose puts it";
  return {};
}

std::string LowView::Impl::doubt_of_line(const cv::Mat& image, const SheetFitResult& result) const {
  const Picture picture{image.data, image.cols, image.rows, image.channels(), image.step[0]};
  return vision::doubt(weigh_hog_line(picture, response, {view.lens(), result.eMc, setup.ice}));
}

std::string LowView::Impl::why_no_hog_line(int too_thin) const {
  return too_thin > 0 ? "lines lie across the ice, but none as wide as the hog line" : "nothing lies across the ice";
}

}  // namespace hogline::vision
