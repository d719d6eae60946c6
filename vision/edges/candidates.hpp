// Where in a long profile an edge or a thin line may be: a coarse look, to the pixel, over all colours.
#pragma once

#include <array>
#include <span>

#include "vision/edges/profile.hpp"

namespace hogline::vision {

struct Candidate {
  double offset_px = 0.0;
  double strength = 0.0;  ///< change of light over all channels (root of the sum of squares), linear light
};

/// Up to four places, strongest first.
struct Candidates {
  static constexpr int max_count = 4;
  int count = 0;
  std::array<Candidate, max_count> at{};

  std::span<const Candidate> list() const { return {at.data(), static_cast<std::size_t>(count)}; }
};

/// Local maxima of the difference between the light on either side, blurred by `blur_px` (standard deviation).
/// Weaker ones than four times the profile's noise are left out.
Candidates find_steps(const Profile& profile, double blur_px);

/// The same for a line `width_px` wide: it must differ from both its sides, in the same sense.
Candidates find_ridges(const Profile& profile, double width_px, double blur_px);

}  // namespace hogline::vision
