#include "hw/sim/sheet_painter.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hogline::hw::sim {
namespace {

constexpr int tile_w = RayTable::tile_width;
constexpr int tile_h = RayTable::tile_height;
constexpr float refraction_m = 0.06F;  // the surface's place less the paint's, at most
constexpr float shadow_radii = 1.6F;   // of a stone's shadow, in the stone's own
constexpr float shadow_strength = 0.7F;

struct Span {
  float nearest2;
  float farthest2;
};

// How near and how far a rectangle comes to a point, squared.
Span distance2(const Reach& at, float x, float y) {
  const float dx0 = std::max({at.x0 - x, x - at.x1, 0.0F});
  const float dy0 = std::max({at.y0 - y, y - at.y1, 0.0F});
  const float dx1 = std::max(std::abs(at.x0 - x), std::abs(at.x1 - x));
  const float dy1 = std::max(std::abs(at.y0 - y), std::abs(at.y1 - y));
  return {dx0 * dx0 + dy0 * dy0, dx1 * dx1 + dy1 * dy1};
}

float shadow_radius_m(const StoneLook& stone) { return shadow_radii * static_cast<float>(stone.radius_m); }

}  // namespace

void Reach::include(const Reach& other) {
  x0 = std::min(x0, other.x0);
  x1 = std::max(x1, other.x1);
  y0 = std::min(y0, other.y0);
  y1 = std::max(y1, other.y1);
}

bool Reach::meets(const PaintedRect& r, float margin_m) const {
  return r.x1_m + margin_m >= x0 && r.x0_m - margin_m <= x1 && r.y1_m + margin_m >= y0 && r.y0_m - margin_m <= y1;
}

bool Reach::meets(float x_m, float y_m, float radius_m) const {
  return x_m + radius_m >= x0 && x_m - radius_m <= x1 && y_m + radius_m >= y0 && y_m - radius_m <= y1;
}

SheetPainter::SheetPainter(const SheetAppearance& look, const SheetPaint& paint, const RayTable& rays,
                           const LightField& field, float edge_variance)
    : look_(look),
      paint_(paint),
      rays_(rays),
      field_(field),
      edge_variance_(edge_variance),
      divider_margin_m_(refraction_m + static_cast<float>(look.rope_sway_m)) {}

Reach SheetPainter::reach(int i, int j) const {
  Reach r;
  Smear smear;
  for (int k = 0; k < 4; ++k) {
    const std::size_t c = field_.corner(i + k % 2, j + k / 2);
    r.include({field_.paint_x(c), field_.paint_x(c), field_.paint_y(c), field_.paint_y(c)});
    smear.x_m = std::max(smear.x_m, std::abs(field_.smear(c).x_m));
    smear.y_m = std::max(smear.y_m, std::abs(field_.smear(c).y_m));
  }
  // Half an edge's width in pixels, as a share of the tile's smaller side, and half as much again for perspective.
  const float share = 1.5F * (0.5F * std::sqrt(20.0F * edge_variance_) + 1.0F) / static_cast<float>(tile_h);
  const float grow_x = share * (r.x1 - r.x0) + smear.x_m;
  const float grow_y = share * (r.y1 - r.y0) + smear.y_m;
  return {r.x0 - grow_x, r.x1 + grow_x, r.y0 - grow_y, r.y1 + grow_y};
}

void SheetPainter::choose(const IceScene& scene, int j, PaintDesk& desk) const {
  Reach row;
  desk.reaches.resize(static_cast<std::size_t>(rays_.tiles_across()));
  for (int i = 0; i < rays_.tiles_across(); ++i) {
    Reach& at = desk.reaches[static_cast<std::size_t>(i)];
    at = reach(i, j);
    row.include(at);
  }
  desk.rects.clear();
  for (const PaintedRect& r : paint_.rects) {
    if (row.meets(r, 0.0F)) desk.rects.push_back(&r);
  }
  desk.dividers.clear();
  for (const PaintedRect& r : scene.dividers) {
    if (row.meets(r, divider_margin_m_)) desk.dividers.push_back(&r);
  }
  desk.stones.clear();
  for (const StoneLook& s : scene.stones) {
    if (row.meets(static_cast<float>(s.x_m), static_cast<float>(s.y_m), shadow_radius_m(s) + refraction_m)) {
      desk.stones.push_back(&s);
    }
  }
}

// The colour of the paint in the tile's middle, lines apart.
Colour SheetPainter::ground(int i, int j) const {
  const std::size_t a = field_.corner(i, j);
  const std::size_t b = field_.corner(i + 1, j + 1);
  const float x = 0.5F * (field_.paint_x(a) + field_.paint_x(b));
  const float y = 0.5F * (field_.paint_y(a) + field_.paint_y(b));
  for (const PaintedHouse& house : paint_.houses) {
    const float r2 = (x - house.x_m) * (x - house.x_m) + (y - house.y_m) * (y - house.y_m);
    for (std::size_t ring = 4; ring-- > 0;) {
      if (r2 < house.radii_m[ring] * house.radii_m[ring]) return look_.rings[ring];
    }
  }
  return look_.ice;
}

bool SheetPainter::ring_edges(const Reach& at) const {
  for (const PaintedHouse& house : paint_.houses) {
    const Span d2 = distance2(at, house.x_m, house.y_m);
    for (const float radius : house.radii_m) {
      if (d2.nearest2 <= radius * radius && d2.farthest2 >= radius * radius) return true;
    }
  }
  return false;
}

// Rings that fill the tile are painted, too: the next edge is drawn on them.
void SheetPainter::paint_rings(const Reach& at, IceTile& tile) const {
  for (const PaintedHouse& house : paint_.houses) {
    const Span d2 = distance2(at, house.x_m, house.y_m);
    for (std::size_t ring = 0; ring < 4; ++ring) {
      const float r2 = house.radii_m[ring] * house.radii_m[ring];
      if (d2.nearest2 > r2) break;
      if (d2.farthest2 < r2) {
        tile.fill(look_.rings[ring]);
      } else {
        tile.paint_disc(house.x_m, house.y_m, house.radii_m[ring], look_.rings[ring]);
      }
    }
  }
}

// Ice, rings, lines, shadows, dividers, in the order in which they cover each other. False: the tile is all `plain`.
bool SheetPainter::paint(const IceScene& scene, int i, int j, const Colour& plain, PaintDesk& desk) const {
  const Reach& at = desk.reaches[static_cast<std::size_t>(i)];
  const auto crosses = [&at](float margin) {
    return [&at, margin](const PaintedRect* r) { return at.meets(*r, margin); };
  };
  const auto darkens = [&at](const StoneLook* s) {
    return at.meets(static_cast<float>(s->x_m), static_cast<float>(s->y_m), shadow_radius_m(*s) + refraction_m);
  };
  const bool rings = ring_edges(at);
  const bool anything = rings || std::any_of(desk.rects.begin(), desk.rects.end(), crosses(0.0F)) ||
                        std::any_of(desk.dividers.begin(), desk.dividers.end(), crosses(divider_margin_m_)) ||
                        std::any_of(desk.stones.begin(), desk.stones.end(), darkens);
  if (!anything) return false;

  const Smear a = field_.smear(field_.corner(i, j));
  const Smear b = field_.smear(field_.corner(i + 1, j + 1));
  IceTile& tile = desk.tile;
  tile.aim(scene.view, rays_, i * tile_w, j * tile_h, {0.5F * (a.x_m + b.x_m), 0.5F * (a.y_m + b.y_m)}, edge_variance_);
  tile.fill(rings ? look_.ice : plain);
  if (rings) paint_rings(at, tile);
  const auto draw = [&](const PaintedRect& r, float margin, bool on_surface) {
    if (!at.meets(r, margin)) return;
    tile.paint_rect(r, on_surface, r.x0_m + margin >= at.x0 || r.x1_m - margin <= at.x1,
                    r.y0_m >= at.y0 || r.y1_m <= at.y1);
  };
  for (const PaintedRect* r : desk.rects) draw(*r, 0.0F, false);
  for (const StoneLook* s : desk.stones) {
    if (darkens(s))
      tile.shade(static_cast<float>(s->x_m), static_cast<float>(s->y_m), shadow_radius_m(*s), shadow_strength);
  }
  for (const PaintedRect* r : desk.dividers) draw(*r, divider_margin_m_, true);
  return true;
}

void SheetPainter::light(int i, int j, const IceTile* tile, const Colour& plain, Strip& strip) const {
  const std::size_t c00 = field_.corner(i, j);
  const std::size_t c10 = field_.corner(i + 1, j);
  const std::size_t c01 = field_.corner(i, j + 1);
  const std::size_t c11 = field_.corner(i + 1, j + 1);
  const std::array<const float*, 3> planes =
      tile != nullptr ? std::array{tile->red(), tile->green(), tile->blue()} : std::array<const float*, 3>{};
  const std::array colour{plain.red, plain.green, plain.blue};
  for (int y = 0; y < tile_h; ++y) {
    const float down = (static_cast<float>(y) + 0.5F) / tile_h;
    const auto between = [down](float top, float bottom) { return top + down * (bottom - top); };
    const float light0 = between(field_.on_ice_light(c00), field_.on_ice_light(c01));
    const float light_step = (between(field_.on_ice_light(c10), field_.on_ice_light(c11)) - light0) / tile_w;
    const float gloss0 = between(field_.gloss(c00), field_.gloss(c01));
    const float gloss_step = (between(field_.gloss(c10), field_.gloss(c11)) - gloss0) / tile_w;
    for (std::size_t p = 0; p < 3; ++p) {
      float* out = strip.row(static_cast<int>(p), y) + i * tile_w;
      if (tile == nullptr) {
        const float base = colour[p] * light0 + gloss0;
        const float slope = colour[p] * light_step + gloss_step;
        for (int x = 0; x < tile_w; ++x) out[x] = base + slope * (static_cast<float>(x) + 0.5F);
        continue;
      }
      const float* albedo = planes[p] + y * tile_w;
      for (int x = 0; x < tile_w; ++x) {
        const float along = static_cast<float>(x) + 0.5F;
        out[x] = albedo[x] * (light0 + light_step * along) + gloss0 + gloss_step * along;
      }
    }
  }
}

void SheetPainter::lay(const IceScene& scene, int i, int j, PaintDesk& desk, Strip& strip) const {
  const Colour plain = ground(i, j);
  const bool varied = paint(scene, i, j, plain, desk);
  light(i, j, varied ? &desk.tile : nullptr, plain, strip);
}

}  // namespace hogline::hw::sim
