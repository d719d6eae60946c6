#include "vision/near_view.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "vision/detect/edge_points.hpp"
#include "vision/detect/four_points.hpp"
#include "vision/detect/house_segmentation.hpp"
#include "vision/detect/line_candidates.hpp"
#include "vision/detect/line_classes.hpp"
#include "vision/detect/point_pose.hpp"
#include "vision/detect/ring_ellipse.hpp"
#include "vision/detect/ring_vote.hpp"
#include "vision/fit/sheet_fit.hpp"
#include "vision/fit_percept.hpp"
#include "vision/near_view_sketch.hpp"
#include "vision/picture/picture_shape.hpp"

namespace hogline::vision {
namespace {

constexpr std::size_t most_lines = 60;
constexpr std::size_t most_candidates = 4;  // of each class in the search over (h, l, r)
constexpr double worst_reprojection_px = 12.0;
constexpr double mount_tilt_rad = 0.05;  // how far roll, pitch and height may be from the mount's
constexpr double mount_height_m = 0.25;

// Calibrated cameras leave 0.08 to 0.17 px (30 path-traced scenes); a picture that is not this camera's own can be
// explained by a wrong pose and 0.6 px.
constexpr double most_residual_px = 0.5;

/// A pose to start the joint fit from, and where it comes from.
struct Hypothesis {
  Pose eMc;
  double search_px;
  std::string origin;
};

// The back line or the hog line in plain sight, and little of it there: a house seen from its other side or from beside
// it, where rings, tee line and centre line look the same.
bool a_line_is_missing(const SheetFitResult& result) {
  return std::ranges::any_of(result.features, [](const FittedFeature& f) {
    const int in_sight = f.sites_tried - f.sites_hidden;
    const bool plain = in_sight >= 20 && in_sight >= 0.5 * f.sites_tried;
    return (f.name == "back_line" || f.name == "hog_line") && plain && f.sites_used < 0.3 * in_sight;
  });
}

template <typename T>
std::vector<T> first(const std::vector<T>& all) {
  return {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), most_candidates))};
}

}  // namespace

struct NearView::Impl {
  explicit Impl(const CameraSetup& camera_setup)
      : setup(camera_setup), view(camera_setup), response(camera_setup.gamma), fit(camera_setup) {}

  std::optional<Hypothesis> by_four_points(const cv::Mat& image, const std::vector<EdgePoint>& points,
                                           const LineClasses& classes, NearViewSketch* sketch) const;
  std::optional<Hypothesis> by_ring_vote(const std::vector<EdgePoint>& points, const LineClasses& classes) const;
  bool in_range(const Pose& eMc) const;
  std::string doubt(const SheetFitResult& result) const;
  SheetPosePercept percept(const SheetFitResult& result, const std::string& origin, Stamp stamp) const;

  CameraSetup setup;
  GroundView view;
  ResponseCurve response;
  SheetFit fit;
  StandingRange range;
};

NearView::NearView(const CameraSetup& setup) : impl_(std::make_unique<Impl>(setup)) {}
NearView::~NearView() = default;
NearView::NearView(NearView&&) noexcept = default;
NearView& NearView::operator=(NearView&&) noexcept = default;

SheetPosePercept NearView::acquire(const cv::Mat& image, Stamp stamp, NearViewSketch* sketch) {
  SheetPosePercept nothing;
  nothing.stamp = stamp;
  nothing.reason = shape_fault(image, impl_->setup.intrinsics);
  if (!nothing.reason.empty()) return nothing;

  const auto points = find_edge_points(image, impl_->view, {});
  const auto lines = find_line_candidates(points, impl_->view.pixels_per_plane_unit(), most_lines);
  const LineClasses classes = classify(lines, impl_->view, impl_->range);
  if (sketch != nullptr) draw_candidates(classes, impl_->view, *sketch);

  nothing.reason = "no house and lines found that fit a robot before its house";
  for (const bool by_lines : {true, false}) {
    const auto hypothesis =
        by_lines ? impl_->by_four_points(image, points, classes, sketch) : impl_->by_ring_vote(points, classes);
    if (!hypothesis) continue;
    SheetFitStart start;
    start.eMc = hypothesis->eMc;
    start.search_px = hypothesis->search_px;
    start.may_be_hidden = true;
    start.paint_depth_sigma_m = impl_->setup.paint_depth_sigma_m;
    const SheetFitResult& result = impl_->fit.fit(image, start);
    nothing.reason = result.ok ? impl_->doubt(result) : result.reason;
    if (!nothing.reason.empty()) continue;
    if (sketch != nullptr) draw_model(result.eMc, impl_->setup, result.sheet_width_m, *sketch);
    return impl_->percept(result, hypothesis->origin, stamp);
  }
  return nothing;
}

// The paper's chain: the (h, l, r) whose four points agree best with a pose.
std::optional<Hypothesis> NearView::Impl::by_four_points(const cv::Mat& image, const std::vector<EdgePoint>& points,
                                                         const LineClasses& classes, NearViewSketch* sketch) const {
  if (classes.hog.empty() || classes.left.empty() || classes.right.empty()) return std::nullopt;
  const auto house = segment_house(image, response, view, {classes.hog[0], classes.left[0], classes.right[0]});
  if (!house) return std::nullopt;
  const auto ring = fit_outer_ring(*house, points, view.pixels_per_plane_unit());
  if (!ring) return std::nullopt;
  if (sketch != nullptr) sketch->ring_contour = ring->contour;

  std::optional<PointPose> best;
  FourPoints best_points;
  for (const ClassifiedLine& h : first(classes.hog)) {
    for (const ClassifiedLine& l : first(classes.left)) {
      for (const ClassifiedLine& r : first(classes.right)) {
        const auto four = four_points(ring->conic, h.line.homogeneous(), l.line.homogeneous(), r.line.homogeneous());
        if (!four) continue;
        const auto pose = epnp(*four);
        if (!pose || (best && pose->reprojection >= best->reprojection) || !in_range(pose->eMc)) continue;
        best = pose;
        best_points = *four;
      }
    }
  }
  if (!best || best->reprojection * view.pixels_per_plane_unit() > worst_reprojection_px) return std::nullopt;
  if (sketch != nullptr) {
    for (const auto& p : best_points.plane) {
      if (const auto pixel = view.pixel_of_plane(p)) sketch->four_points.push_back(*pixel);
    }
  }
  const auto refined = refine_pose(best_points, best->eMc);
  if (!refined || !in_range(refined->eMc)) return std::nullopt;
  return Hypothesis{refined->eMc, 12.0, "four_points"};
}

// Where lines are missing or hidden: the rings' common centre, and the direction that most lines agree on.
std::optional<Hypothesis> NearView::Impl::by_ring_vote(const std::vector<EdgePoint>& points,
                                                       const LineClasses& classes) const {
  const auto vote = vote_for_house(points, range);
  const auto yaw_rad = consensus_yaw(classes);
  if (!vote || !yaw_rad) return std::nullopt;
  // The house's centre is e's origin: seen from the body it lies at R(-yaw) * (-x, -y).
  const double c = std::cos(*yaw_rad);
  const double s = std::sin(*yaw_rad);
  const PlanarPose body{-(c * vote->centre.x() - s * vote->centre.y()), -(s * vote->centre.x() + c * vote->centre.y()),
                        *yaw_rad};
  const Pose eMc = eMb(body) * bMc(setup.mount);
  if (!in_range(eMc)) return std::nullopt;
  return Hypothesis{eMc, 16.0, "ring_vote"};
}

bool NearView::Impl::in_range(const Pose& eMc) const {
  const PlanarPose body = planar_body(eMc, setup.mount);
  const Eigen::Vector3d up = (eMc.linear() * bMc(setup.mount).linear().transpose()).row(2).transpose();
  return std::abs(body.x_m) < range.max_x_m + 0.2 && body.y_m > range.min_y_m - 0.3 && body.y_m < range.max_y_m + 0.3 &&
         std::abs(body.yaw_rad) < range.max_yaw_rad + 0.02 && std::abs(up.x()) < mount_tilt_rad &&
         std::abs(up.y()) < mount_tilt_rad && std::abs(eMc.translation().z() - setup.mount.z_m) < mount_height_m;
}

// Why a fit that converged is not believed. Rings alone do not tell the yaw: lines must be seen, and agree.
std::string NearView::Impl::doubt(const SheetFitResult& result) const {
  if (!in_range(result.eMc)) return "the fitted pose is out of the range of a robot before its house";
  if (result.residual_px > most_residual_px) {
    return "the paint does not lie where this camera's calibration puts it: is the picture this camera's own?";
  }
  int rings_tried = 0;
  int rings_used = 0;
  int lines_tried = 0;
  int lines_used = 0;
  for (const FittedFeature& f : result.features) {
    const bool ring = f.name.ends_with("_ring");
    (ring ? rings_tried : lines_tried) += f.sites_tried - f.sites_hidden;
    (ring ? rings_used : lines_used) += f.sites_used;
  }
  if (rings_used < 60 || rings_used < 0.4 * rings_tried) return "the rings are not where the pose puts them";
  if (lines_used < 40 || lines_used < 0.4 * lines_tried) return "the lines are not where the pose puts them";
  if (a_line_is_missing(result)) return "a line is missing where the pose puts it";
  return {};
}

SheetPosePercept NearView::Impl::percept(const SheetFitResult& result, const std::string& origin, Stamp stamp) const {
  SheetPosePercept p;
  p.stamp = stamp;
  p.features.push_back(origin);
  fill_percept(result, p);
  return p;
}

}  // namespace hogline::vision
