#include "hw/sim/sheet_paint.hpp"

#include <algorithm>

namespace hogline::hw::sim {
namespace {

using namespace vision::rules;

constexpr double ice_behind_hack_m = 3.0;
constexpr double end_y_m = tee_to_tee_m + tee_to_hack_m + ice_behind_hack_m;
constexpr double begin_y_m = -tee_to_hack_m - ice_behind_hack_m;

PaintedRect rect(double x0, double x1, double y0, double y1, const Colour& colour) {
  return {static_cast<float>(x0), static_cast<float>(x1), static_cast<float>(y0), static_cast<float>(y1), colour};
}

bool raised(Divider divider) { return divider == Divider::bumper || divider == Divider::rope; }

// From one sheet's centre line to the next one's.
double pitch_m(const SheetAppearance& sheet) {
  switch (sheet.divider) {
    case Divider::line:
      return sheet.width_m + 2.0 * sheet.divider_width_m + sheet.neighbour_gap_m;
    case Divider::none:
      return sheet.width_m + sheet.neighbour_gap_m;
    default:
      return sheet.width_m + sheet.divider_width_m;
  }
}

void add_houses(std::vector<PaintedHouse>& houses, double x) {
  for (const double y : {0.0, tee_to_tee_m}) {
    PaintedHouse house{static_cast<float>(x), static_cast<float>(y), {}};
    for (std::size_t i = 0; i < 4; ++i) house.radii_m[i] = static_cast<float>(ring_radii_m[i]);
    houses.push_back(house);
  }
}

void add_courtesy_lines(std::vector<PaintedRect>& rects, const SheetAppearance& sheet, double x) {
  constexpr double from_hog = hog_line_width_m + courtesy_to_hog_m;
  const double half = sheet.width_m / 2.0;
  for (const double y : {tee_to_hog_m + from_hog, tee_to_tee_m - tee_to_hog_m - from_hog - thin_line_width_m}) {
    rects.push_back(rect(x - half, x - half + courtesy_length_m, y, y + thin_line_width_m, sheet.thin_lines));
    rects.push_back(rect(x + half - courtesy_length_m, x + half, y, y + thin_line_width_m, sheet.thin_lines));
  }
}

void add_hacks(std::vector<PaintedRect>& rects, double x) {
  const Colour rubber{0.01F, 0.01F, 0.01F};
  for (const double y : {-tee_to_hack_m - 0.10, tee_to_tee_m + tee_to_hack_m - 0.10}) {
    rects.push_back(rect(x - 0.23, x - 0.075, y, y + 0.203, rubber));
    rects.push_back(rect(x + 0.075, x + 0.23, y, y + 0.203, rubber));
  }
}

void add_lines(std::vector<PaintedRect>& rects, const SheetAppearance& sheet, double x) {
  const double half = sheet.width_m / 2.0;
  for (const auto& line : vision::cross_lines()) {
    const bool hog = line.name.find("hog") != std::string_view::npos;
    rects.push_back(
        rect(x - half, x + half, line.near_edge_y_m, line.far_edge_y_m, hog ? sheet.hog_line : sheet.thin_lines));
  }
  rects.push_back(rect(x - thin_line_width_m / 2.0, x + thin_line_width_m / 2.0, vision::centre_line_begin_y_m,
                       vision::centre_line_end_y_m, sheet.thin_lines));
  if (sheet.courtesy_lines) add_courtesy_lines(rects, sheet, x);
  if (sheet.hacks) add_hacks(rects, x);
  if (sheet.divider != Divider::line) return;
  rects.push_back(rect(x - half - sheet.divider_width_m, x - half, begin_y_m, end_y_m, sheet.divider_colour));
  rects.push_back(rect(x + half, x + half + sheet.divider_width_m, begin_y_m, end_y_m, sheet.divider_colour));
}

Colour dimmed(const Colour& c, float by) { return {c.red * by, c.green * by, c.blue * by}; }

}  // namespace

SheetPaint sheet_paint(const SheetAppearance& sheet) {
  SheetPaint paint;
  const double pitch = pitch_m(sheet);
  const double half = sheet.width_m / 2.0;
  const int side = sheet.neighbours ? 1 : 0;

  for (const Logo& logo : sheet.logos) {
    paint.rects.push_back(rect(logo.x_m - logo.width_m / 2.0, logo.x_m + logo.width_m / 2.0,
                               logo.y_m - logo.length_m / 2.0, logo.y_m + logo.length_m / 2.0, logo.colour));
  }
  for (int i = -side; i <= side; ++i) {
    add_houses(paint.houses, i * pitch);
    add_lines(paint.rects, sheet, i * pitch);
  }
  if (raised(sheet.divider)) {
    for (int i = -side; i <= side + 1; ++i) {
      const double x0 = (i - 0.5) * pitch - sheet.divider_width_m / 2.0;
      paint.dividers.push_back({x0, x0 + sheet.divider_width_m, sheet.divider_height_m});
    }
  }
  const double reach = side * pitch + half + sheet.divider_width_m + 0.25;
  paint.bounds = {static_cast<float>(-reach), static_cast<float>(reach), static_cast<float>(begin_y_m),
                  static_cast<float>(end_y_m)};
  return paint;
}

std::vector<PaintedRect> seen_dividers(const SheetPaint& paint, const SheetAppearance& sheet, double camera_x_m,
                                       double camera_z_m) {
  std::vector<PaintedRect> seen;
  const float sway = sheet.divider == Divider::rope ? static_cast<float>(sheet.rope_sway_m) : 0.0F;
  for (const RaisedDivider& d : paint.dividers) {
    if (camera_z_m <= d.height_m) continue;
    const double stretch = camera_z_m / (camera_z_m - d.height_m);
    const double top0 = camera_x_m + (d.x0_m - camera_x_m) * stretch;
    const double top1 = camera_x_m + (d.x1_m - camera_x_m) * stretch;
    for (const bool top : {false, true}) {
      PaintedRect r = rect(top ? top0 : std::min(d.x0_m, top0), top ? top1 : std::max(d.x1_m, top1), begin_y_m, end_y_m,
                           dimmed(sheet.divider_colour, top ? 1.0F : 0.6F));
      r.sway_m = sway;
      r.wavelength_m = static_cast<float>(sheet.rope_wavelength_m);
      seen.push_back(r);
    }
  }
  return seen;
}

}  // namespace hogline::hw::sim
