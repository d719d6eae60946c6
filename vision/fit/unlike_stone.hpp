// Which parts of a stone's place do not look like a stone's: whoever stands or reaches before it.
#pragma once

#include <opencv2/core/mat.hpp>

#include "vision/detect/stone_team.hpp"
#include "vision/fit/stone_patch.hpp"

namespace hogline::vision {

struct UnlikeStone {
  cv::Rect area;       ///< of the picture
  cv::Mat unlike;      ///< CV_8UC1 of the area's size: 255 where most of what is near is no stone's
  double share = 0.0;  ///< of what a stone would cover
  double ice = 0.0;    ///< share of what is no stone's that may be ice: nobody stands there
};

/// Within the outlines of a stone at `place`: the plate must have the hue of one team, the body the club's granite, be
/// they light or dark. About the outlines themselves nothing is judged; they go with what is beside them.
UnlikeStone unlike_stone(const StonePicture& picture, const Eigen::Vector2d& place, const Light& granite,
                         const TeamHues& teams);

}  // namespace hogline::vision
