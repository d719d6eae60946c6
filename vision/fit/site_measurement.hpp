// Looking for one planned site in the picture.
#pragma once

#include <array>

#include "vision/edges/candidates.hpp"
#include "vision/edges/localise.hpp"
#include "vision/edges/profile.hpp"
#include "vision/fit/site_planner.hpp"

namespace hogline::vision {

/// Where the site's edge was found: pixels along its normal from the predicted place.
struct SiteMeasurement {
  bool found = false;
  double offset_px = 0.0;
  double sigma_px = 0.0;
  double blur_px = 0.0;
  double contrast = 0.0;
  std::array<float, 3> colour{};
};

struct PictureLight {
  Picture picture;
  const ResponseCurve& response;
};

/// Places within `search_px` of the prediction where the site's edge may be. `profile` is room to work in.
Candidates look_widely(const PictureLight& light, const PlannedSite& site, double search_px, Profile& profile);

/// To a fraction of a pixel, within `search_px` of the prediction; the mean of up to `2 * half_breadth + 1` cuts.
SiteMeasurement look_closely(const PictureLight& light, const PlannedSite& site, double search_px, int half_breadth,
                             Profile& profile);

}  // namespace hogline::vision
