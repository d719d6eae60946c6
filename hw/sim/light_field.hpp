// What changes slowly over the picture, at the corners of its tiles: where the ice is seen, how it is lit and what it
// mirrors. Between the corners it is interpolated.
#pragma once

#include <vector>

#include "hw/sim/appearance.hpp"
#include "hw/sim/ice_tile.hpp"
#include "hw/sim/ray_table.hpp"
#include "hw/sim/solids.hpp"

namespace hogline::hw::sim {

class LightField {
 public:
  LightField(const RayTable& rays, const vision::Intrinsics& intrinsics, const LightAppearance& light,
             const Hall& hall);

  /// Works out every corner for a camera that moves from `begin` to `end` during the exposure, with `view` in the
  /// middle.
  void look(const IceView& view, const IceView& begin, const IceView& end, bool moving);

  /// The corner at the left and top of tile (i, j); i may be tiles_across(), j tiles_down().
  std::size_t corner(int i, int j) const { return static_cast<std::size_t>(j * across_ + i); }

  struct Ray3 {
    float x, y, z;
  };
  Ray3 ray(std::size_t k) const { return {rx_[k], ry_[k], rz_[k]}; }
  bool on_ice(std::size_t k) const { return on_ice_[k] != 0; }
  float paint_x(std::size_t k) const { return px_[k]; }
  float paint_y(std::size_t k) const { return py_[k]; }
  Smear smear(std::size_t k) const { return {smear_x_[k], smear_y_[k]}; }
  float on_ice_light(std::size_t k) const { return light_[k]; }      ///< on a surface of reflectance 1
  float in_hall_light(std::size_t k) const { return vignette_[k]; }  ///< on the hall and on what stands in it
  float gloss(std::size_t k) const { return gloss_[k]; }             ///< what the ice mirrors, to be added

 private:
  void mirror_lamps(const IceView& view);

  LightAppearance appearance_;
  Hall hall_;
  int across_;
  std::vector<float> rx_, ry_, rz_, vignette_;
  std::vector<float> sx_, sy_, px_, py_, smear_x_, smear_y_, light_, gloss_;
  std::vector<float> ax_, ay_, bx_, by_, unused_x_, unused_y_, descent_;
  std::vector<char> valid_, on_ice_;
};

}  // namespace hogline::hw::sim
