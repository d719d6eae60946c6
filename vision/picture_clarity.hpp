// Whether stones can be told in a picture at all: a lens out of focus or misted over, a camera that moved while it
// exposed, or a gain run away leave the sheet's lines in place and take the stones away, so that an empty sheet would
// be believed.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "vision/detect/white_light.hpp"
#include "vision/geometry/sheet_camera.hpp"

namespace hogline::vision {

/// What the stone finder bears (2026-11, 14 path-traced scenes and 40 boards of hw/sim that were blurred and made
/// noisy): up to there 97 of a hundred stones that it finds in the clear picture, soon afterwards three quarters, then
/// none. Those pictures themselves have 0.8 to 1.2 px and 0.003 to 0.010.
struct ClarityLimits {
  double blur_px = 1.6;
  double noise = 0.040;
};

struct PictureClarity {
  /// Of the house's painted rings: standard deviation in pixels, geometric mean of that along rows and along columns;
  /// empty where too little of them is seen.
  std::optional<double> blur_px;
  /// Of a pixel's light against white ice, in its square root: standard deviation; empty where hardly any ice is seen.
  std::optional<double> noise;

  /// Why stones can not be told in it, for a person; empty when they can, or when it is not known.
  std::string fault(const ClarityLimits& limits = {}) const;
};

/// Of a picture whose pose is known. Precondition: CV_8UC3, not empty.
PictureClarity clarity_of(const cv::Mat& bgr, const ResponseCurve& response, const WhiteLight& ice,
                          const SheetCamera& camera);

}  // namespace hogline::vision
