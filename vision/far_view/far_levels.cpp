#include "vision/far_view/far_levels.hpp"

#include <algorithm>
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

void FarLevels::begin(const cv::Mat& bgr, int top, const ResponseCurve& response, const Pose& eMc, const Ice& ice) {
  levels_[0].bgr = bgr;
  int first = std::clamp(top, 0, bgr.rows - 16) & ~15;
  for (std::size_t i = 1; i < count; ++i, first /= 2) {
    const cv::Mat& larger = levels_[i - 1].bgr;
    const cv::Size half(larger.cols / 2, larger.rows / 2);
    levels_[i].bgr.create(half, CV_8UC3);
    cv::Mat lower = levels_[i].bgr.rowRange(first / 2, half.height);
    cv::resize(larger(cv::Rect(0, first, 2 * half.width, 2 * half.height - first)), lower, lower.size(), 0.0, 0.0,
               cv::INTER_AREA);
  }
  levels_[1].ice.emplace(levels_[1].bgr, response, 2 * first);
  levels_[0].ice = levels_[1].ice->in_smaller(0.5);
  levels_[2].ice = levels_[1].ice->in_smaller(2.0);
  look_from(eMc, ice);
  whole_ = true;
}

void FarLevels::go_on(const cv::Mat& bgr, const Pose& eMc, const Ice& ice) {
  levels_[0].bgr = bgr;
  look_from(eMc, ice);
  whole_ = false;
}

void FarLevels::look_from(const Pose& eMc, const Ice& ice) {
  for (FarLevel& level : levels_) level.camera.emplace(*level.lens, eMc, ice);
}

void FarLevels::fill(int level, const cv::Rect& area) {
  if (whole_ || level == 0) return;
  cv::Mat& here = levels_[static_cast<std::size_t>(level)].bgr;
  const cv::Rect inside = area & cv::Rect({0, 0}, here.size());
  if (inside.empty()) return;
  const cv::Rect twice(2 * inside.x, 2 * inside.y, 2 * inside.width, 2 * inside.height);
  fill(level - 1, twice);
  cv::Mat part = here(inside);
  cv::resize(levels_[static_cast<std::size_t>(level - 1)].bgr(twice), part, part.size(), 0.0, 0.0, cv::INTER_AREA);
}

int FarLevels::level_at(double range_m, const Intrinsics& intrinsics) {
  int level = 0;
  while (level + 1 < count && intrinsics.fx_px / (range_m * (1 << level)) > most_px_per_m) ++level;
  return level;
}

}  // namespace hogline::vision
