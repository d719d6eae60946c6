#include "vision/fit/site_planner.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "vision/fit/paint.hpp"
#include "vision/geometry/sheet.hpp"

namespace hogline::vision {
namespace {

constexpr double stretch_px = 120.0;     // sites within this share their errors
constexpr double least_width_px = 0.35;  // a line thinner than this is lost in the noise
constexpr double least_ground_step_m = 0.004;
constexpr double most_ground_step_m = 0.4;
constexpr double border_px = 3.0;

// The cut that a close look takes through a site lies in the picture.
bool measurable(const Lens& lens, const PlannedSite& site) {
  constexpr double search_px = 1.5;
  const double window_px = 3.0 * site.blur_px + 3.0;
  const Eigen::Vector2d before = (0.5 * site.width_px + std::min(site.before_px, window_px) + search_px) * site.normal;
  const Eigen::Vector2d after = (0.5 * site.width_px + std::min(site.after_px, window_px) + search_px) * site.normal;
  return lens.in_picture(site.pixel - before) && lens.in_picture(site.pixel + after);
}

double least_room_px(double blur_px) { return 1.2 * blur_px + 1.0; }

// A divider's foot is seen between the shade it throws on the ice and its mirror image in it: measured 0.3-0.5 px of
// scatter that neighbouring sites share, where paint has 0.1.
constexpr double foot_floor_px = 0.5;
// Further away the shade is thinner than a pixel and pulls the foot inwards: measured 0.5 px.
constexpr double most_foot_m_per_px = 0.012;

// A curve on the sheet: its points, its direction, and the direction its edge faces.
struct Curve {
  PaintShape shape;
  double fixed_m;  // ring: radius; across: y; along: x
  double side;     // of along: the sign of the outward x
  bool on_surface = false;

  Eigen::Vector2d at(double u) const {
    if (shape == PaintShape::ring) return {fixed_m * std::cos(u), fixed_m * std::sin(u)};
    return shape == PaintShape::across ? Eigen::Vector2d(u, fixed_m) : Eigen::Vector2d(fixed_m, u);
  }
  Eigen::Vector2d direction(double u) const {
    if (shape == PaintShape::ring) return {-fixed_m * std::sin(u), fixed_m * std::cos(u)};
    return shape == PaintShape::across ? Eigen::Vector2d(1.0, 0.0) : Eigen::Vector2d(0.0, 1.0);
  }
  Eigen::Vector2d facing(double u) const {
    if (shape == PaintShape::ring) return {std::cos(u), std::sin(u)};
    return shape == PaintShape::across ? Eigen::Vector2d(0.0, 1.0) : Eigen::Vector2d(side, 0.0);
  }
};

// Pixel, normal and derivatives of a place on a curve. False where the picture does not tell its direction.
bool project(const Curve& curve, double u, const PaintProjection& seen, PlannedSite& site) {
  const Eigen::Vector2d tangent = seen.by_paint * curve.direction(u);
  const double speed = tangent.norm();
  if (!(speed > 1e-6)) return false;
  Eigen::Vector2d normal(-tangent.y() / speed, tangent.x() / speed);
  if (normal.dot(seen.by_paint * curve.facing(u)) < 0.0) normal = -normal;
  site.pixel = seen.pixel;
  site.normal = normal;
  site.along.setZero();
  site.along.segment<6>(parameter::twist) = normal.transpose() * seen.by_pose;
  site.along[parameter::depth] = normal.dot(seen.by_depth);
  return true;
}

// A line seen as one: its middle between its edges at `first` and `second`, and its width.
bool centre_on_band(const SheetCamera& camera, const Curve& first, const Curve& second, double u, PlannedSite& site) {
  const auto p1 = camera.project_paint(first.at(u));
  const auto p2 = camera.project_paint(second.at(u));
  if (!p1 || !p2) return false;
  const double t1 = site.normal.dot(*p1 - site.pixel);
  const double t2 = site.normal.dot(*p2 - site.pixel);
  site.width_px = std::abs(t2 - t1);
  site.pixel += 0.5 * (t1 + t2) * site.normal;
  return site.width_px >= least_width_px;
}

// How a sideline's own parameters move the site; `by_width` is its share of the paint's width.
void move_by_sideline(const Curve& curve, const PaintProjection& seen, int edge_parameter, double by_width,
                      bool moves_camera, PlannedSite& site) {
  if (edge_parameter >= 0) {
    const double by_x = curve.side * site.normal.dot(seen.by_paint.col(0));
    site.along[edge_parameter] = by_x;
    site.along[edge_parameter + 1] = by_width * by_x;
  }
  if (!moves_camera) site.along.segment<6>(parameter::twist).setZero();
}

struct Planner {
  const SheetCamera& camera;
  const SheetCamera& over_surface;  // without refraction, for what stands on the ice
  const FitState& state;
  const SitePlan& plan;
  std::vector<PlannedSite>& sites;

  const SheetCamera& camera_for(const Curve& curve) const { return curve.on_surface ? over_surface : camera; }

  // One site: what all kinds share. False when it can not be used.
  bool place(int feature, const Curve& curve, double u, const PaintProjection& seen, PlannedSite& site,
             Eigen::Vector2d& per_px) const {
    site.feature = feature;
    site.place = u;
    if (!project(curve, u, seen, site)) return false;
    const Eigen::Vector2d tangent(site.normal.y(), -site.normal.x());
    const Eigen::Matrix2d to_ground = seen.by_paint.inverse();
    const double travelled_px = std::abs(site.normal.dot(seen.by_paint.col(1))) * plan.travel_m;
    site.blur_px = std::hypot(plan.optical_blur_px, travelled_px / std::sqrt(12.0));
    per_px = to_ground * site.normal;
    const Eigen::Vector2d beside = to_ground * tangent;
    const Room room = room_around({curve.at(u), per_px, beside}, feature, state, 1.0 + 2.0 * site.blur_px, 40.0);
    site.before_px = room.before_px;
    site.after_px = room.after_px;
    const double least = least_room_px(site.blur_px);
    return room.before_px >= least && room.after_px >= least;
  }

  // Steps along the curve evenly in the picture and hands each visible place to `use(u, projection, step_px)`.
  template <typename Use>
  void walk(const Curve& curve, double begin, double end, const Use& use) const {
    const double per_unit = curve.shape == PaintShape::ring ? curve.fixed_m : 1.0;
    double along_px = 0.0;
    for (double u = begin; u < end;) {
      const auto seen = camera_for(curve).project_paint_with_jacobian(curve.at(u));
      double step = most_ground_step_m / per_unit;
      if (seen && seen->pixel.allFinite()) {
        const double speed = (seen->by_paint * curve.direction(u)).norm();
        step = std::clamp(plan.spacing_px / speed, least_ground_step_m / per_unit, step);
        const bool visible = camera.lens().in_picture(seen->pixel, border_px);
        if (visible) {
          use(u, *seen, static_cast<int>(along_px / stretch_px));
          along_px += step * speed;
        } else {
          step = std::max(step, 0.02 / per_unit);
        }
      } else {
        step = 0.05 / per_unit;
      }
      u += step;
    }
  }

  double curvature(const Curve& curve, double u, const PlannedSite& site, const PaintProjection& seen) const {
    const double speed = (seen.by_paint * curve.direction(u)).norm();
    const double du = 4.0 / speed;
    const auto before = camera.project_paint(curve.at(u - du));
    const auto after = camera.project_paint(curve.at(u + du));
    if (!before || !after) return 0.0;
    const double half_chord2 = 0.25 * (*after - *before).squaredNorm();
    return 2.0 * site.normal.dot(0.5 * (*before + *after) - seen.pixel) / half_chord2;
  }

  void ring(int feature, double radius_m) const {
    const Curve curve{PaintShape::ring, radius_m, 1.0};
    walk(curve, -std::numbers::pi, std::numbers::pi, [&](double u, const PaintProjection& seen, int stretch) {
      PlannedSite site;
      Eigen::Vector2d per_px;
      if (!place(feature, curve, u, seen, site, per_px)) return;
      site.stretch = stretch;
      site.sense = 1;
      site.curvature = curvature(curve, u, site, seen);
      sites.push_back(site);
    });
  }

  // A band of paint between two curves at `first_m` and `second_m`: its middle while thin, its edges when wide.
  // `edge_parameter` >= 0: the first edge's distance is a parameter, the paint's width the next one.
  void band(int feature, PaintShape shape, double first_m, double second_m, double begin, double end, double side,
            int edge_parameter, bool moves_camera) const {
    const Curve middle{shape, 0.5 * (first_m + second_m), side};
    walk(middle, begin, end, [&](double u, const PaintProjection& seen, int stretch) {
      PlannedSite site;
      Eigen::Vector2d per_px;
      if (!place(feature, middle, u, seen, site, per_px)) return;
      site.stretch = stretch;
      const Curve first{shape, first_m, side};
      const Curve second{shape, second_m, side};
      if (!centre_on_band(camera, first, second, u, site)) return;
      if (site.width_px > 7.0 * site.blur_px + 4.0) {
        edge(feature, first, u, stretch, edge_parameter, 0.0, moves_camera);
        edge(feature, second, u, stretch, edge_parameter, 1.0, moves_camera);
        return;
      }
      site.step = false;
      site.before_px -= 0.5 * site.width_px;
      site.after_px -= 0.5 * site.width_px;
      if (std::min(site.before_px, site.after_px) < least_room_px(site.blur_px)) return;
      move_by_sideline(middle, seen, edge_parameter, 0.5, moves_camera, site);
      sites.push_back(site);
    });
  }

  // One edge of a wide band, or a divider's foot.
  void edge(int feature, const Curve& curve, double u, int stretch, int edge_parameter, double by_width,
            bool moves_camera) const {
    const auto seen = camera_for(curve).project_paint_with_jacobian(curve.at(u));
    if (!seen || !camera.lens().in_picture(seen->pixel, border_px)) return;
    PlannedSite site;
    Eigen::Vector2d per_px;
    if (!place(feature, curve, u, *seen, site, per_px)) return;
    site.stretch = stretch;
    site.sense = by_width > 0.0 ? -1 : 1;
    move_by_sideline(curve, *seen, edge_parameter, by_width, moves_camera, site);
    if (curve.on_surface) {
      if (std::abs(per_px.x()) > most_foot_m_per_px) return;
      site.floor_px = foot_floor_px;
      site.before_px = std::min(site.before_px, 1.5 * site.blur_px + 1.0);
    }
    // The band's other edge: at least 7 blurs away, but it ends the window.
    const double other_px = 7.0 * site.blur_px + 2.0;
    if (by_width > 0.0) {
      site.before_px = std::min(site.before_px, other_px);
    } else if (edge_parameter >= 0 || curve.shape == PaintShape::across) {
      site.after_px = std::min(site.after_px, other_px);
    }
    sites.push_back(site);
  }

  void sideline(int feature, int which, double side) const {
    const Sideline& line = state.sidelines[static_cast<std::size_t>(which)];
    if (!line.known) return;
    const int index = which == 0 ? parameter::left_edge : parameter::right_edge;
    const double begin = camera.eMc().translation().y() - 1.0;
    const double end = begin + 30.0;
    if (line.is_line) {
      band(feature, PaintShape::sideline, side * line.edge_m, side * (line.edge_m + line.paint_m), begin, end, side,
           index, line.moves_camera);
      return;
    }
    const Curve foot{PaintShape::sideline, side * line.edge_m, side, true};
    walk(foot, begin, end, [&](double u, const PaintProjection&, int stretch) {
      edge(feature, foot, u, stretch, index, 0.0, line.moves_camera);
    });
  }
};

}  // namespace

void plan_sites(const SheetCamera& camera, const FitState& state, const SitePlan& plan,
                std::vector<PlannedSite>& sites) {
  const SheetCamera over_surface(camera.lens(), camera.eMc(), Ice{0.0, camera.ice().refractive_index});
  const Planner planner{camera, over_surface, state, plan, sites};
  const auto& features = paint_features();
  for (int i = 0; i < paint_feature_count; ++i) {
    if (plan.only_feature >= 0 && i != plan.only_feature) continue;
    const PaintFeature& f = features[static_cast<std::size_t>(i)];
    switch (f.shape) {
      case PaintShape::ring:
        planner.ring(i, f.begin_m);
        break;
      case PaintShape::across:
        planner.band(i, f.shape, f.begin_m, f.end_m, -plan.half_width_m, plan.half_width_m, 1.0, -1, true);
        break;
      case PaintShape::centre_line:
        planner.band(i, f.shape, f.begin_m, f.end_m, centre_line_begin_y_m, centre_line_end_y_m, 1.0, -1, true);
        break;
      case PaintShape::sideline:
        planner.sideline(i, f.begin_m < 0.0 ? 0 : 1, f.begin_m);
        break;
    }
  }
}

void SiteCameras::move_to(const Pose& eMc) {
  paint.move_to(eMc);
  surface.move_to(eMc);
}

bool reproject(const SiteCameras& cameras, const FitState& state, PlannedSite& site) {
  const PaintFeature& f = paint_features()[static_cast<std::size_t>(site.feature)];
  const bool sideline = f.shape == PaintShape::sideline;
  const Sideline& line = state.sidelines[f.begin_m < 0.0 ? 0 : 1];
  Curve first{f.shape, f.begin_m, sideline ? f.begin_m : 1.0};
  Curve second{f.shape, f.end_m, first.side};
  if (sideline) {
    first.fixed_m = first.side * line.edge_m;
    second.fixed_m = first.side * (line.edge_m + line.paint_m);
    first.on_surface = !line.is_line;
  }
  const bool band = f.shape != PaintShape::ring && !site.step;
  const bool far_edge = f.shape != PaintShape::ring && site.step && site.sense < 0;
  Curve curve = far_edge ? second : first;
  if (band) curve.fixed_m = 0.5 * (first.fixed_m + second.fixed_m);

  const SheetCamera& camera = curve.on_surface ? cameras.surface : cameras.paint;
  const auto seen = camera.project_paint_with_jacobian(curve.at(site.place));
  if (!seen || !camera.lens().in_picture(seen->pixel, border_px)) return false;
  PlannedSite moved = site;
  if (!project(curve, site.place, *seen, moved)) return false;
  if (band && !centre_on_band(camera, first, second, site.place, moved)) return false;
  if (sideline) {
    const int edge_parameter = f.begin_m < 0.0 ? parameter::left_edge : parameter::right_edge;
    move_by_sideline(curve, *seen, edge_parameter, band ? 0.5 : (far_edge ? 1.0 : 0.0), line.moves_camera, moved);
  }
  if (!measurable(camera.lens(), moved)) return false;
  site = moved;
  return true;
}

}  // namespace hogline::vision
