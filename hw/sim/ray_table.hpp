// The lens' ray of every pixel, worked out once.
#pragma once

#include <vector>

#include "vision/geometry/lens.hpp"

namespace hogline::hw::sim {

/// Rays in c, in float, in three planes. The table reaches `apron` pixels beyond the picture on the left and above, and
/// to the next full tile and a little more on the right and below. A pixel outside the lens model's range has the ray
/// (0, 0, 0).
class RayTable {
 public:
  static constexpr int tile_width = 16;
  static constexpr int tile_height = 8;
  static constexpr int apron = 1;

  explicit RayTable(const vision::Lens& lens);

  int tiles_across() const { return tiles_across_; }
  int tiles_down() const { return tiles_down_; }

  /// The rays from pixel (u, v) on to the right. Precondition: u, v >= -apron.
  const float* x(int u, int v) const { return &x_[index(u, v)]; }
  const float* y(int u, int v) const { return &y_[index(u, v)]; }
  const float* z(int u, int v) const { return &z_[index(u, v)]; }

 private:
  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v + apron) * static_cast<std::size_t>(stride_) +
           static_cast<std::size_t>(u + apron);
  }

  int tiles_across_;
  int tiles_down_;
  int stride_;
  std::vector<float> x_;
  std::vector<float> y_;
  std::vector<float> z_;
};

}  // namespace hogline::hw::sim
