// Lays the ice and its paint into the tiles of a picture; only where an edge may be is anything worked out per pixel.
#pragma once

#include <vector>

#include "hw/sim/appearance.hpp"
#include "hw/sim/ice_tile.hpp"
#include "hw/sim/light_field.hpp"
#include "hw/sim/sheet_paint.hpp"
#include "hw/sim/strip.hpp"

namespace hogline::hw::sim {

/// What of the ice changes from exposure to exposure.
struct IceScene {
  IceView view;
  std::vector<PaintedRect> dividers;  ///< as seen from the camera
  std::vector<StoneLook> stones;      ///< they darken the ice about them
};

/// The part of the sheet that a tile may show, with what blur brings in from outside. In e, metres.
struct Reach {
  float x0 = 1e9F;
  float x1 = -1e9F;
  float y0 = 1e9F;
  float y1 = -1e9F;
  void include(const Reach& other);
  bool meets(const PaintedRect& rect, float margin_m) const;
  bool meets(float x_m, float y_m, float radius_m) const;
};

/// Memory of one working thread.
struct PaintDesk {
  IceTile tile;
  std::vector<Reach> reaches;
  std::vector<const PaintedRect*> rects;
  std::vector<const PaintedRect*> dividers;
  std::vector<const StoneLook*> stones;
};

class SheetPainter {
 public:
  /// The references are kept. `edge_variance` as for IceTile::aim().
  SheetPainter(const SheetAppearance& look, const SheetPaint& paint, const RayTable& rays, const LightField& field,
               float edge_variance);

  /// What of the scene may be seen in row j of the tiles. Call before lay() for the tiles of that row.
  void choose(const IceScene& scene, int j, PaintDesk& desk) const;

  /// Ice and paint of tile (i, j).
  void lay(const IceScene& scene, int i, int j, PaintDesk& desk, Strip& strip) const;

  /// Bare ice in tile (i, j).
  void lay_bare(int i, int j, Strip& strip) const { light(i, j, nullptr, look_.ice, strip); }

 private:
  Reach reach(int i, int j) const;
  Colour ground(int i, int j) const;
  bool ring_edges(const Reach& at) const;
  void paint_rings(const Reach& at, IceTile& tile) const;
  bool paint(const IceScene& scene, int i, int j, const Colour& plain, PaintDesk& desk) const;
  void light(int i, int j, const IceTile* tile, const Colour& plain, Strip& strip) const;

  const SheetAppearance& look_;
  const SheetPaint& paint_;
  const RayTable& rays_;
  const LightField& field_;
  float edge_variance_;
  float divider_margin_m_;  ///< a divider's place on the surface less the paint's under it, and its sway, at most
};

}  // namespace hogline::hw::sim
