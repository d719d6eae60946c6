#include "vision/detect/ground_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hogline::vision {

GroundView::GroundView(const CameraSetup& setup)
    : setup_(setup),
      lens_(setup.intrinsics),
      gMc_(eMb(PlanarPose{}) * bMc(setup.mount)),
      columns_(setup.intrinsics.width_px / cell_px + 2),
      rows_(setup.intrinsics.height_px / cell_px + 2) {
  const Eigen::Vector2d nowhere = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  table_.reserve(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  for (int r = 0; r < rows_; ++r) {
    for (int c = 0; c < columns_; ++c) {
      const auto ray = lens_.ray({static_cast<double>(c * cell_px), static_cast<double>(r * cell_px)});
      table_.push_back(ray && ray->z() > 0.05 ? Eigen::Vector2d(ray->head<2>() / ray->z()) : nowhere);
    }
  }
}

std::optional<Eigen::Vector2d> GroundView::plane(const Eigen::Vector2d& pixel) const {
  const double u = pixel.x() / cell_px;
  const double v = pixel.y() / cell_px;
  if (!(u >= 0.0 && v >= 0.0 && u < columns_ - 1 && v < rows_ - 1)) return std::nullopt;
  const int c = static_cast<int>(u);
  const int r = static_cast<int>(v);
  const double fu = u - c;
  const double fv = v - r;
  const Eigen::Vector2d* cell = table_.data() + static_cast<std::ptrdiff_t>(r) * columns_ + c;
  const Eigen::Vector2d n =
      (1.0 - fv) * ((1.0 - fu) * cell[0] + fu * cell[1]) + fv * ((1.0 - fu) * cell[columns_] + fu * cell[columns_ + 1]);
  if (!n.allFinite()) return std::nullopt;
  return n;
}

std::optional<Eigen::Vector2d> GroundView::ground_of_plane(const Eigen::Vector2d& n) const {
  const Eigen::Vector3d direction = gMc_.linear() * Eigen::Vector3d(n.x(), n.y(), 1.0);
  if (!(direction.z() < -1e-3)) return std::nullopt;
  const double range = -gMc_.translation().z() / direction.z();
  return Eigen::Vector2d(gMc_.translation().head<2>() + range * direction.head<2>());
}

std::optional<Eigen::Vector2d> GroundView::plane_of_ground(const Eigen::Vector2d& g) const {
  const Eigen::Vector3d c = gMc_.inverse() * Eigen::Vector3d(g.x(), g.y(), 0.0);
  if (!(c.z() > 1e-3)) return std::nullopt;
  return Eigen::Vector2d(c.head<2>() / c.z());
}

std::optional<Eigen::Vector2d> GroundView::pixel_of_plane(const Eigen::Vector2d& n) const {
  return lens_.project({n.x(), n.y(), 1.0});
}

std::optional<Eigen::Vector2d> GroundView::pixel_of_ground(const Eigen::Vector2d& g) const {
  return lens_.project(gMc_.inverse() * Eigen::Vector3d(g.x(), g.y(), 0.0));
}

int GroundView::first_row(double range_m) const {
  const int height = setup_.intrinsics.height_px;
  double first = height;
  for (double x = -6.0; x <= 6.0; x += 0.5) {
    const auto pixel = pixel_of_ground({x, range_m});
    if (pixel && lens_.in_picture(*pixel)) first = std::min(first, pixel->y());
  }
  return std::clamp(static_cast<int>(first), 0, height - 1);
}

}  // namespace hogline::vision
