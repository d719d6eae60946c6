// The painted sheet in the end's frame e (World Curling, Rules of Curling, R1 "Sheet"): origin at the tee, y towards
// the other end, x to the right looking along y, paint a little below z = 0.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace hogline::vision {

/// Distances in metres from the rules.
namespace rules {
inline constexpr double tee_to_tee_m = 34.747;
inline constexpr double tee_to_hog_m = 6.401;       ///< to the hog line's house-side edge
inline constexpr double hog_line_width_m = 0.1016;  ///< its paint lies towards mid-sheet
inline constexpr double tee_to_back_m = 1.829;      ///< to the back line's outer edge
inline constexpr double tee_to_hack_m = 3.658;
inline constexpr double thin_line_width_m = 0.0127;  ///< tee, back and centre lines
inline constexpr double outer_ring_radius_m = 1.829;
inline constexpr double middle_ring_radius_m = 1.219;
inline constexpr double inner_ring_radius_m = 0.610;
inline constexpr double button_radius_m = 0.152;    ///< clubs paint up to 0.23
inline constexpr double courtesy_to_hog_m = 1.219;  ///< outside the hog line
inline constexpr double courtesy_length_m = 0.152;
inline constexpr double min_width_m = 4.318;
inline constexpr double nominal_width_m = 4.75;
inline constexpr double max_width_m = 5.0;
inline constexpr double stone_radius_m = 0.145;
inline constexpr std::array<double, 4> ring_radii_m{outer_ring_radius_m, middle_ring_radius_m, inner_ring_radius_m,
                                                    button_radius_m};
}  // namespace rules

enum class SidelineKind { line, bumper, none, unknown };

/// What the rig file says of the sheet; the width is for the program to find.
struct SheetConfig {
  double width_m = rules::nominal_width_m;
  SidelineKind sideline = SidelineKind::unknown;
};

/// A line of paint across the sheet: y between two edges, any x between the sidelines.
struct CrossLine {
  std::string_view name;
  double near_edge_y_m;  ///< the smaller y
  double far_edge_y_m;
  constexpr double centre_y_m() const { return 0.5 * (near_edge_y_m + far_edge_y_m); }
  constexpr double width_m() const { return far_edge_y_m - near_edge_y_m; }
};

/// The lines across, of the house at e's origin and of the one at the other end, by growing y:
/// back_line, tee_line, hog_line, far_hog_line, far_tee_line, far_back_line.
std::span<const CrossLine> cross_lines();

/// One of cross_lines() by its name. Precondition: it exists.
const CrossLine& cross_line(std::string_view name);

/// The centre line's ends on y, from hack to hack; it is at x = 0, thin_line_width_m wide.
inline constexpr double centre_line_begin_y_m = -rules::tee_to_hack_m;
inline constexpr double centre_line_end_y_m = rules::tee_to_tee_m + rules::tee_to_hack_m;

}  // namespace hogline::vision
