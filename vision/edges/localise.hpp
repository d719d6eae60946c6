// Where exactly an edge or a thin line lies in a profile: least squares of a blurred step, or of a blurred bar of known
// width, with its place, blur, contrast and background free. Symmetric blur of any shape leaves the place unbiased.
#pragma once

#include <array>

#include "vision/edges/profile.hpp"

namespace hogline::vision {

enum class EdgeFault {
  none,
  too_short,      ///< too few samples in the window
  no_contrast,    ///< nothing stands out of the noise
  left_window,    ///< the fit ran away from where it was told to look
  not_like_that,  ///< the residual says that the profile is of something else
};

/// What to expect.
struct EdgeExpectation {
  double offset_px = 0.0;   ///< about where
  double width_px = 0.0;    ///< of the bar; 0 for a step
  double blur_px = 1.0;     ///< standard deviation
  double before_px = 6.0;   ///< the window reaches this far beyond the edge (the bar's first edge) ...
  double after_px = 6.0;    ///< ... and beyond it (the bar's second edge) the other way
  double max_shift_px = 3;  ///< the place found is within this of offset_px
};

struct LocalEdge {
  EdgeFault fault = EdgeFault::too_short;
  double offset_px = 0.0;         ///< of the step, or of the bar's centre, along the profile
  double sigma_px = 0.0;          ///< from the residual and the fit's normal matrix (Cramer-Rao for its noise)
  double contrast = 0.0;          ///< along `colour`, > 0, linear light
  double blur_px = 0.0;           ///< fitted standard deviation
  std::array<float, 3> colour{};  ///< unit: the change of light across the step, or of the bar against its sides
  bool ok() const { return fault == EdgeFault::none; }
};

/// The three channels are joined along their own change of light, green before red and blue: paint of any colour
/// counts, and a mosaic sensor's coarse colours move it little.
LocalEdge locate(const Profile& profile, const EdgeExpectation& expected);

}  // namespace hogline::vision
