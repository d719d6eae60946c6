// The paint of our sheet and its neighbours as a list of simple shapes, in e, in the order in which they are painted.
#pragma once

#include <array>
#include <vector>

#include "hw/sim/appearance.hpp"

namespace hogline::hw::sim {

/// Four filled circles about one tee.
struct PaintedHouse {
  float x_m = 0.0F;
  float y_m = 0.0F;
  std::array<float, 4> radii_m{};
};

/// A filled rectangle along e's axes. `sway_m` bends it along y: x is measured from a wavy line.
struct PaintedRect {
  float x0_m = 0.0F;
  float x1_m = 0.0F;
  float y0_m = 0.0F;
  float y1_m = 0.0F;
  Colour colour;
  float sway_m = 0.0F;
  float wavelength_m = 1.0F;
};

/// A bumper or rope on the ice.
struct RaisedDivider {
  double x0_m = 0.0;
  double x1_m = 0.0;
  double height_m = 0.0;
};

/// The ice that is there at all: the boards stand around it.
struct IceBounds {
  float x0_m = 0.0F;
  float x1_m = 0.0F;
  float y0_m = 0.0F;
  float y1_m = 0.0F;
};

struct SheetPaint {
  std::vector<PaintedHouse> houses;
  std::vector<PaintedRect> rects;
  std::vector<RaisedDivider> dividers;
  IceBounds bounds;
};

/// Both houses and all lines of one to three sheets.
SheetPaint sheet_paint(const SheetAppearance& sheet);

/// What a camera at (x, z) sees of the dividers, as rectangles on the surface: the face, then the top.
std::vector<PaintedRect> seen_dividers(const SheetPaint& paint, const SheetAppearance& sheet, double camera_x_m,
                                       double camera_z_m);

}  // namespace hogline::hw::sim
