#include "vision/detect/stone_outline.hpp"

#include <algorithm>
#include <numbers>

namespace hogline::vision {
namespace {

constexpr double pi = std::numbers::pi;
// The fit parts what stands nearer than a stone; a wrong peak must not take a stone along.
constexpr double removal_m = 0.14;
constexpr std::array<double, 3> thicknesses{0.5, 1.0, 1.6};  // of the handle, in those of the shape

/// A stone at one place, as the camera sees it.
class Drawing {
 public:
  Drawing(const SheetCamera& camera, const StoneShape& shape, const Eigen::Vector2d& place,
          const Eigen::Vector2d& centre)
      : camera_(camera),
        shape_(shape),
        place_(place),
        centre_(centre),
        eye_(camera.eMc().translation()),
        bearing_(bearing_of(place, eye_)) {}

  bool circle(double height_m, double a, OutlineMark& mark) const {
    return add([&](double b) { return circle_point(place_, bearing_, shape_.handle_radius_m, height_m, b); }, a, mark);
  }
  bool body(double a, OutlineMark& mark) const {
    return add([&](double b) { return body_outline_point(place_, shape_, eye_, b); }, a, mark);
  }
  /// How far it is in the picture to a point of the handle's plane; 0 where that can not be seen.
  float reach(double radius_m, double a) const {
    const auto pixel = camera_.project(circle_point(place_, bearing_, radius_m, shape_.handle_height_m, a));
    return pixel ? static_cast<float>((*pixel - centre_).norm()) : 0.0F;
  }
  double range_m() const { return bearing_.range_m; }

 private:
  template <typename Curve>
  bool add(const Curve& curve, double a, OutlineMark& mark) const {
    const auto p = camera_.project(curve(a));
    const auto next = camera_.project(curve(a + 0.02));
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
  Eigen::Vector3d eye_;
  Bearing bearing_;
};

bool draw_handle(const Drawing& drawing, const StoneShape& shape, StoneOutline& outline) {
  bool ok = true;
  for (std::size_t i = 0; i < StoneOutline::handle_marks; ++i) {
    const double a = pi * (0.08 + 0.12 * static_cast<double>(i));
    ok = ok && drawing.circle(shape.handle_height_m, a, outline.far_rim[i]);
    for (std::size_t k = 0; k < thicknesses.size(); ++k) {
      const double height_m = shape.handle_height_m - thicknesses[k] * shape.handle_thickness_m;
      ok = ok && drawing.circle(height_m, -a, outline.near_edge[i][k]);
    }
  }
  return ok;
}

// Both sides from below the waist to the shoulder, and the foot.
bool draw_body(const Drawing& drawing, StoneOutline& outline) {
  bool ok = true;
  for (std::size_t i = 0; i < 5; ++i) {
    const double a = -0.9 + 0.35 * static_cast<double>(i);
    ok = ok && drawing.body(a, outline.body[2 * i]) && drawing.body(pi - a, outline.body[2 * i + 1]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    ok = ok && drawing.body(-0.5 * pi + 0.4 * (static_cast<double>(i) - 1.0), outline.body[10 + i]);
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
