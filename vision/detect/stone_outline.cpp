#include "vision/detect/stone_outline.hpp"

#include <algorithm>
#include <numbers>

namespace hogline::vision {
namespace {

constexpr double pi = std::numbers::pi;
// The fit parts what stands nearer than a stone; a wrong peak must not take a stone along.
constexpr double removal_m = 0.14;
constexpr std::array<double, 3> thicknesses{0.5, 1.0, 1.6};  // of the handle, in those of the shape

/// A place of an outline, and the next one that shows its direction.
struct Step {
  Turn at, next;
  explicit Step(double a) : at(a), next(a + 0.02) {}
};

/// Where the marks are on their curves: the same in each outline.
struct Steps {
  std::vector<Step> far_rim, near_edge;
  std::vector<Step> body;  ///< both sides from below the waist to the shoulder, and the foot
  Steps() {
    for (std::size_t i = 0; i < StoneOutline::handle_marks; ++i) {
      const double a = pi * (0.08 + 0.12 * static_cast<double>(i));
      far_rim.emplace_back(a);
      near_edge.emplace_back(-a);
    }
    for (int i = 0; i < 5; ++i) {
      const double a = -0.9 + 0.35 * i;
      body.emplace_back(a);
      body.emplace_back(pi - a);
    }
    for (int i = -1; i <= 1; ++i) body.emplace_back(-0.5 * pi + 0.4 * i);
  }
};

const Steps steps;

/// A stone at one place, as the camera sees it.
class Drawing {
 public:
  Drawing(const SheetCamera& camera, const StoneShape& shape, const Eigen::Vector2d& place,
          const Eigen::Vector2d& centre)
      : camera_(camera),
        shape_(shape),
        place_(place),
        centre_(centre),
        bearing_(bearing_of(place, camera.eMc().translation())) {}

  bool circle(double height_m, const Step& step, OutlineMark& mark) const {
    return add([&](const Turn& t) { return circle_point(place_, bearing_, shape_.handle_radius_m, height_m, t); }, step,
               mark);
  }
  bool body(const BodyOutline& outline, const Step& step, OutlineMark& mark) const {
    return add([&](const Turn& t) { return outline.at(t); }, step, mark);
  }
  BodyOutline body_outline() const { return {place_, shape_, camera_.eMc().translation()}; }
  /// How far it is in the picture to a point of the handle's plane; 0 where that can not be seen.
  float reach(double radius_m, double a) const {
    const auto pixel = camera_.project(circle_point(place_, bearing_, radius_m, shape_.handle_height_m, a));
    return pixel ? static_cast<float>((*pixel - centre_).norm()) : 0.0F;
  }
  double range_m() const { return bearing_.range_m; }

 private:
  template <typename Curve>
  bool add(const Curve& curve, const Step& step, OutlineMark& mark) const {
    const auto p = camera_.project(curve(step.at));
    const auto next = camera_.project(curve(step.next));
    if (!p || !next) return false;
    const Eigen::Vector2d along = (*next - *p).normalized();
    mark = {static_cast<float>(p->x() - centre_.x()), static_cast<float>(p->y() - centre_.y()),
            static_cast<float>(-along.y()), static_cast<float>(along.x())};
    return along.allFinite();
  }

  const SheetCamera& camera_;
  const StoneShape& shape_;
  Eigen::Vector2d place_;
  Eigen::Vector2d centre_;
  Bearing bearing_;
};

bool draw_handle(const Drawing& drawing, const StoneShape& shape, StoneOutline& outline) {
  bool ok = true;
  for (std::size_t i = 0; i < StoneOutline::handle_marks; ++i) {
    ok = ok && drawing.circle(shape.handle_height_m, steps.far_rim[i], outline.far_rim[i]);
    for (std::size_t k = 0; k < thicknesses.size(); ++k) {
      const double height_m = shape.handle_height_m - thicknesses[k] * shape.handle_thickness_m;
      ok = ok && drawing.circle(height_m, steps.near_edge[i], outline.near_edge[i][k]);
    }
  }
  return ok;
}

bool draw_body(const Drawing& drawing, StoneOutline& outline) {
  const BodyOutline body = drawing.body_outline();
  bool ok = true;
  for (std::size_t i = 0; i < StoneOutline::body_marks; ++i) {
    ok = ok && drawing.body(body, steps.body[i], outline.body[i]);
  }
  return ok;
}

void choose_first_marks(StoneOutline& outline) {
  for (std::size_t i = 0; i < StoneOutline::first_body_marks; ++i) outline.first_body[i] = outline.body[3 * i];
  for (std::size_t i = 0; i < StoneOutline::first_handle_marks / 2; ++i) {
    outline.first_handle[2 * i] = outline.near_edge[3 * i + 1][1];
    outline.first_handle[2 * i + 1] = outline.far_rim[3 * i + 1];
  }
}

}  // namespace

void OutlineTable::begin(const SheetCamera& camera, const StoneShape& shape, const StoneArea& area) {
  camera_ = &camera;
  shape_ = &shape;
  area_ = area;
  const Intrinsics& k = camera.lens().intrinsics();
  columns_ = k.width_px / block_px + 1;
  outlines_.assign(static_cast<std::size_t>(columns_ * (k.height_px / block_px + 1)), nullptr);
  used_ = 0;
}

const StoneOutline* OutlineTable::make(const Eigen::Vector2d& pixel) {
  if (used_ == memory_.size()) memory_.emplace_back();
  StoneOutline& outline = memory_[used_++];
  outline.seen = draw(pixel, outline);
  return &outline;
}

bool OutlineTable::draw(const Eigen::Vector2d& pixel, StoneOutline& outline) const {
  const auto place = camera_->plane_at(pixel, shape_->handle_height_m);
  if (!place || !area_.contains(*place)) return false;
  const Drawing drawing(*camera_, *shape_, *place, pixel);
  if (drawing.range_m() < 2.0 * shape_->body_radius_m) return false;
  if (!draw_handle(drawing, *shape_, outline) || !draw_body(drawing, outline)) return false;
  choose_first_marks(outline);
  outline.removal_x = drawing.reach(removal_m, 0.0);
  outline.removal_y = std::max(2.0F, drawing.reach(removal_m, 0.5 * pi));
  outline.half_width_px = drawing.reach(shape_->handle_radius_m, 0.0);
  outline.half_depth_px = drawing.reach(shape_->handle_radius_m, 0.5 * pi);
  return outline.removal_x > 0.0F;
}

}  // namespace hogline::vision
