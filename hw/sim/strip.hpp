// One row of tiles of the picture in linear light.
#pragma once

#include <vector>

#include "hw/sim/ray_table.hpp"

namespace hogline::hw::sim {

class Strip {
 public:
  explicit Strip(int width_px)
      : stride_(width_px), light_(static_cast<std::size_t>(3 * RayTable::tile_height * width_px)) {}

  /// Row `y` of plane 0 red, 1 green, 2 blue.
  float* row(int plane, int y) {
    return &light_[static_cast<std::size_t>((plane * RayTable::tile_height + y) * stride_)];
  }

 private:
  int stride_;
  std::vector<float> light_;
};

}  // namespace hogline::hw::sim
