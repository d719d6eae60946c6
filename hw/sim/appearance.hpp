// What the simulated rink looks like. Plain structs, SI units; colours are reflectances in linear light.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "vision/geometry/sheet.hpp"

namespace hogline::hw::sim {

/// Share of the light that a surface gives back, linear, 0..1. Above 1 it shines by itself.
struct Colour {
  float red = 0.0F;
  float green = 0.0F;
  float blue = 0.0F;
};

/// What separates two sheets. A rope lies on the ice, as a bumper does, but it sways.
enum class Divider { line, bumper, rope, none };

/// A painted rectangle: an advertisement, a club's logo.
struct Logo {
  double x_m = 0.0;  ///< centre in e
  double y_m = 0.0;
  double width_m = 0.0;   ///< along x
  double length_m = 0.0;  ///< along y
  Colour colour;
};

/// Our sheet and its neighbours, which are painted alike.
struct SheetAppearance {
  double width_m = vision::rules::nominal_width_m;  ///< between the sidelines' inner edges
  Divider divider = Divider::line;
  double divider_width_m = 0.04;
  double divider_height_m = 0.08;  ///< of bumper and rope
  double rope_sway_m = 0.02;       ///< amplitude
  double rope_wavelength_m = 5.0;  ///< of the sway
  bool neighbours = true;          ///< sheets to the left and right are painted too
  double neighbour_gap_m = 0.2;    ///< between our painted sideline and the neighbour's
  std::array<Colour, 4> rings{
      {{0.02F, 0.07F, 0.45F}, {0.88F, 0.89F, 0.90F}, {0.55F, 0.02F, 0.02F}, {0.88F, 0.89F, 0.90F}}};
  Colour ice{0.86F, 0.87F, 0.88F};
  Colour hog_line{0.50F, 0.02F, 0.02F};
  Colour thin_lines{0.02F, 0.02F, 0.05F};  ///< centre, tee, back and courtesy lines
  Colour divider_colour{0.02F, 0.02F, 0.02F};
  bool courtesy_lines = true;
  bool hacks = true;
  std::vector<Logo> logos;
};

/// The hall around the ice: a box with boards about the ice, panels on the walls and lamps under the ceiling.
struct HallAppearance {
  double height_m = 6.0;
  double walkway_m = 2.5;  ///< between the boards and the walls
  double board_height_m = 0.25;
  double lamp_spacing_m = 6.0;  ///< along the sheet
  double lamp_length_m = 1.2;   ///< along the sheet
  double lamp_width_m = 0.35;
  Colour walls{0.10F, 0.10F, 0.10F};
  Colour ceiling{0.03F, 0.03F, 0.035F};
  Colour floor{0.05F, 0.05F, 0.055F};
  Colour boards{0.03F, 0.04F, 0.20F};
  bool panels = true;  ///< advertisements on the far wall and along the boards
};

struct LightAppearance {
  double level = 0.75;          ///< of full scale: a surface of reflectance 1 in the picture's middle
  double falloff_per_m = 0.0;   ///< relative change of the light per metre of x
  double vignetting = 0.25;     ///< share of the light lost in the picture's corners
  double lamp_gloss = 0.5;      ///< brightness of the lamps' reflections, 0 for none
  double roughness_rad = 0.02;  ///< spread of the pebble's slopes: how far the reflections smear
};

struct RinkAppearance {
  SheetAppearance sheet;
  HallAppearance hall;
  LightAppearance light;
};

/// A stone on the surface of the ice.
struct StoneLook {
  double x_m = 0.0;  ///< centre in e
  double y_m = 0.0;
  double handle_rad = 0.0;  ///< direction of the handle's bar from e's y axis, counter-clockwise
  double radius_m = vision::rules::stone_radius_m;
  double plate_radius_m = 0.095;
  double plate_height_m = 0.125;
  Colour plate{0.60F, 0.02F, 0.02F};
  Colour granite{0.16F, 0.16F, 0.17F};
};

/// Somebody who stands on the ice or beside it.
struct PersonLook {
  double x_m = 0.0;  ///< in e
  double y_m = 0.0;
  double facing_rad = 0.0;  ///< direction of the look from e's y axis, counter-clockwise
  double height_m = 1.75;
  double stride_m = 0.0;  ///< the left leg ahead of the right by this
  Colour jacket{0.10F, 0.45F, 0.10F};
  Colour trousers{0.03F, 0.03F, 0.05F};
  Colour skin{0.45F, 0.28F, 0.20F};
};

/// The sensor behind the lens.
struct SensorModel {
  double gamma = 1.0;                     ///< pixel = linear^(1/gamma)
  double full_scale_electrons = 10000.0;  ///< shot noise: variance = signal
  double read_noise_electrons = 8.0;
  double pebble_contrast = 0.0;  ///< standard deviation of a pixel's brightness, share of its mean
  double blur_sigma_px = 0.45;   ///< of lens and colour filter, beside the pixel's own square
  bool noisy = true;             ///< false: only the rounding to 8 bits is left
};

}  // namespace hogline::hw::sim
