#include "vision/fit/site_planner.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::vision {
namespace {

constexpr double border_px = 2.0;
constexpr double narrowest_line_px = 0.35;    // below it a line drowns in noise
constexpr double two_edges_from_blurs = 7.0;  // a line wider than this is seen as two separate edges
constexpr double neighbour_gap_m = 0.10;      // the nearest a neighbouring sheet's sideline comes to ours

class Planner {
 public:
  Planner(const std::vector<PaintedFeature>& features, const SheetCamera& camera, const PlanOptions& options,
          std::vector<PlannedSite>& sites)
      : features_(features), camera_(camera), options_(options), sites_(sites) {}

  void plan(int index) {
    const PaintedFeature& feature = features_[static_cast<std::size_t>(index)];
    double parameter = feature.begin_m;
    int guard = 0;
    while (parameter < feature.end_m && ++guard < 4000) parameter += visit(index, feature, parameter);
  }

 private:
  // Adds the site at a parameter, if it can be used, and says how far the next one is.
  double visit(int index, const PaintedFeature& feature, double parameter) {
    const double blind_step = feature.shape == PaintedFeature::Shape::circle ? 0.02 : 0.10;
    const CurvePoint point = point_on(feature, parameter);
    const auto projection = camera_.project_paint_with_jacobian(point.at);
    if (!projection || !camera_.lens().in_picture(projection->pixel, border_px)) return blind_step;
    const Eigen::Vector2d along = projection->by_paint * point.tangent;
    const double speed = along.norm();
    if (!(speed > 1e-6)) return blind_step;
    const double step = std::min(options_.spacing_px / speed, 8.0 * blind_step);

    Eigen::Vector2d normal(-along.y() / speed, along.x() / speed);
    if (normal.dot(projection->by_paint * point.across) < 0.0) normal = -normal;
    const double by_across = normal.dot(projection->by_paint * point.across);
    const double width_px = feature.width_m * by_across;
    if (feature.width_m > 0.0 && width_px < narrowest_line_px) return step;
    if (width_px > two_edges_from_blurs * options_.blur_px) {
      for (const double side : {-0.5, 0.5}) add(index, point.at + side * feature.width_m * point.across, normal, 0.0);
    } else {
      add(index, point.at, normal, width_px);
    }
    return step;
  }

  void add(int index, const Eigen::Vector2d& paint, const Eigen::Vector2d& normal, double line_width_px) {
    const auto projection = camera_.project_paint_with_jacobian(paint);
    if (!projection) return;
    PlannedSite site;
    site.feature = index;
    site.paint = paint;
    site.pixel = projection->pixel;
    site.normal = normal;
    site.by_pose = normal.transpose() * projection->by_pose;
    const PaintedFeature& feature = features_[static_cast<std::size_t>(index)];
    const Eigen::Vector2d across = feature.shape == PaintedFeature::Shape::circle   ? paint.normalized()
                                   : feature.shape == PaintedFeature::Shape::across ? Eigen::Vector2d(0.0, 1.0)
                                                                                    : Eigen::Vector2d(1.0, 0.0);
    site.by_across_px_per_m = normal.dot(projection->by_paint * across);
    site.line_width_px = line_width_px;
    if (clear_of_other_paint(site, projection->by_paint)) sites_.push_back(site);
  }

  bool clear_of_other_paint(const PlannedSite& site, const Eigen::Matrix2d& by_paint) const {
    const double reach_px = options_.search_px + 3.0 * options_.blur_px + site.line_width_px;
    for (std::size_t i = 0; i < features_.size(); ++i) {
      if (static_cast<int>(i) == site.feature) continue;
      const PaintedFeature& other = features_[i];
      const Eigen::Vector2d gap = towards(other, site.paint);
      const double distance = gap.norm();
      if (distance <= 0.5 * other.width_m) return false;
      const double gap_px = (by_paint * gap).norm() * (1.0 - 0.5 * other.width_m / distance);
      if (gap_px < reach_px) return false;
    }
    const PaintedFeature& feature = features_[static_cast<std::size_t>(site.feature)];
    const bool is_sideline = feature.place != PaintedFeature::Place::fixed;
    return !is_sideline || neighbour_gap_m * site.by_across_px_per_m > reach_px;
  }

  const std::vector<PaintedFeature>& features_;
  const SheetCamera& camera_;
  const PlanOptions& options_;
  std::vector<PlannedSite>& sites_;
};

}  // namespace

void plan_sites(const std::vector<PaintedFeature>& features, const SheetCamera& camera, const PlanOptions& options,
                std::vector<PlannedSite>& sites) {
  sites.clear();
  Planner planner(features, camera, options, sites);
  for (int i = 0; i < static_cast<int>(features.size()); ++i) {
    if (!options.coarse_only || features[static_cast<std::size_t>(i)].coarse) planner.plan(i);
  }
}

}  // namespace hogline::vision
