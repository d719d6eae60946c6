// The innermost part of the renderer: what the pixels of one tile see of the paint under the ice. Plain loops over
// arrays of floats that a compiler turns into vector code; deterministic, no allocation.
#pragma once

#include <array>
#include <span>

#include "hw/sim/appearance.hpp"
#include "hw/sim/ray_table.hpp"
#include "hw/sim/sheet_paint.hpp"
#include "vision/geometry/ice.hpp"
#include "vision/geometry/pose.hpp"

namespace hogline::hw::sim {

/// A camera over the ice in floats.
struct IceView {
  std::array<float, 9> eRc{};  ///< row by row
  float x_m = 0.0F;
  float y_m = 0.0F;
  float height_m = 0.0F;
  float paint_depth_m = 0.0F;
  float index2 = 1.0F;  ///< the refractive index squared

  IceView() = default;
  /// Precondition: the camera is above the surface.
  IceView(const vision::Pose& eMc, const vision::Ice& ice);
};

/// Where `n` rays (in c) meet the surface, and the paint that they are refracted to (Snell). Rays at or above the
/// horizon give points very far away. `descent` is by how much a ray falls, in its own lengths.
void trace_ice(const IceView& view, const float* rx, const float* ry, const float* rz, int n, float* surface_x,
               float* surface_y, float* paint_x, float* paint_y, float* descent);

/// How far the paint moves under a pixel during the exposure.
struct Smear {
  float x_m = 0.0F;
  float y_m = 0.0F;
};

/// The pixels of one tile, row by row. Use: aim(), then paint over each other, then read the colours.
class IceTile {
 public:
  static constexpr int width = RayTable::tile_width;
  static constexpr int height = RayTable::tile_height;
  static constexpr int size = width * height;

  /// Traces the tile whose first pixel is (u, v). `edge_variance` is that of an edge's profile in px^2, pixel's square
  /// and blur together.
  void aim(const IceView& view, const RayTable& rays, int u, int v, const Smear& smear, float edge_variance);

  void fill(const Colour& colour);
  /// One filled circle.
  void paint_disc(float x_m, float y_m, float radius_m, const Colour& colour);
  /// A rectangle of paint under the ice, or of something on the surface.
  void paint_rect(const PaintedRect& rect, bool on_surface, bool ends_in_x, bool ends_in_y);
  /// A soft darkness on the ice about a place on the surface.
  void shade(float x_m, float y_m, float radius_m, float strength);

  const float* red() const { return red_.data(); }
  const float* green() const { return green_.data(); }
  const float* blue() const { return blue_.data(); }

 private:
  static constexpr int grid_width = width + 4;  // an apron of one pixel on the left, three on the right
  static constexpr int grid_size = grid_width * (height + 2);
  using Pixels = std::array<float, size>;

  void blend(const Pixels& coverage, const Colour& colour);
  void sharpen(const Pixels& by_u, const Pixels& by_v, float smear_m, Pixels& sharp, Pixels& shrink) const;

  alignas(16) Pixels x_;  ///< the paint under a pixel's centre
  alignas(16) Pixels y_;
  alignas(16) Pixels surface_x_;
  alignas(16) Pixels surface_y_;
  alignas(16) Pixels x_by_u_;  ///< and how it changes from pixel to pixel
  alignas(16) Pixels x_by_v_;
  alignas(16) Pixels y_by_u_;
  alignas(16) Pixels y_by_v_;
  alignas(16) Pixels fall_by_u_;  ///< relative change of the ray's descent from pixel to pixel
  alignas(16) Pixels fall_by_v_;
  alignas(16) Pixels sharp_x_;  ///< 1 / width of an edge across x, in 1/m
  alignas(16) Pixels sharp_y_;
  alignas(16) Pixels shrink_x_;  ///< relative change of the ray's descent towards +x, in 1/m
  alignas(16) Pixels shrink_y_;
  alignas(16) Pixels red_;
  alignas(16) Pixels green_;
  alignas(16) Pixels blue_;
  Smear smear_;
  float spread_ = 1.0F;
  bool x_is_sharp_ = false;  ///< sharp_x_ and shrink_x_ are worked out
  bool y_is_sharp_ = false;
};

}  // namespace hogline::hw::sim
