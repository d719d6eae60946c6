#include "vision/far_view/far_levels.hpp"

#include <opencv2/imgproc.hpp>

namespace hogline::vision {
namespace {

// A millimetre of a stone is not to be more than this: a handle 9 mm thicker than thought is then two pixels off.
constexpr double most_px_per_m = 230.0;

Intrinsics smaller(const Intrinsics& whole, int scale) {
  Intrinsics k = whole;
  k.width_px /= scale;
  k.height_px /= scale;
  k.fx_px /= scale;
  k.fy_px /= scale;
  k.cx_px = (k.cx_px + 0.5) / scale - 0.5;
  k.cy_px = (k.cy_px + 0.5) / scale - 0.5;
  return k;
}

}  // namespace

FarLevels::FarLevels(const Intrinsics& intrinsics) {
  for (std::size_t i = 0; i < count; ++i) {
    levels_[i].scale = 1 << i;
    levels_[i].lens.emplace(smaller(intrinsics, levels_[i].scale));
  }
}

void FarLevels::begin(const cv::Mat& bgr, const ResponseCurve& response) {
  levels_[0].bgr = bgr;
  for (std::size_t i = 1; i < count; ++i) {
    const cv::Mat& larger = levels_[i - 1].bgr;
    const cv::Rect even(0, 0, larger.cols & ~1, larger.rows & ~1);
    cv::resize(larger(even), levels_[i].bgr, {even.width / 2, even.height / 2}, 0.0, 0.0, cv::INTER_AREA);
  }
  levels_[1].ice.emplace(levels_[1].bgr, response, 0);
  levels_[0].ice = levels_[1].ice->in_smaller(0.5);
  levels_[2].ice = levels_[1].ice->in_smaller(2.0);
}

void FarLevels::look_from(const Pose& eMc, const Ice& ice) {
  for (FarLevel& level : levels_) level.camera.emplace(*level.lens, eMc, ice);
}

int FarLevels::level_at(double range_m, const Intrinsics& intrinsics) {
  int level = 0;
  while (level + 1 < count && intrinsics.fx_px / (range_m * (1 << level)) > most_px_per_m) ++level;
  return level;
}

}  // namespace hogline::vision
