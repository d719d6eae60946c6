// Where on a profile the paint's edge, or the middle of a thin line, lies: to hundredths of a pixel.
//
// Both are found by matched filters that are odd (edge) or even (line) about the place they look for, so that blur,
// noise and gain, which are symmetric, do not bias them. Colours are free: the three channels are combined in the
// direction in which they differ most at the place found.
#pragma once

#include <string_view>

#include "vision/edges/profile.hpp"

namespace hogline::vision {

struct Localisation {
  bool ok = false;
  std::string_view reason;          ///< why not, when !ok
  double offset_px = 0.0;           ///< from the profile's centre along the normal
  double sigma_px = 0.0;            ///< one standard deviation, from the noise seen on this profile
  double snr = 0.0;                 ///< the filter's peak over its noise
  std::array<float, 3> contrast{};  ///< per channel: light after the edge less before it; of a line, middle less sides
};

/// A step between two areas. Searched within +-search_px of the centre; `blur_px` is the expected standard deviation
/// of the picture's blur. Precondition: the profile reaches search_px + 3 blur_px to both sides.
Localisation locate_edge(const Profile& profile, double search_px, double blur_px);

/// The middle of a line that is `width_px` wide before blur. As locate_edge; the profile reaches search_px + width_px
/// + 3 blur_px to both sides.
Localisation locate_line(const Profile& profile, double search_px, double width_px, double blur_px);

}  // namespace hogline::vision
