#include "vision/picture/picture_check.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace hogline::vision {
namespace {

constexpr int row_step = 8;
constexpr double full_scale = 255.0;
const cv::Size block_grid(32, 24);

cv::Mat sampled_rows(const cv::Mat& picture) {
  const int rows = (picture.rows + row_step - 1) / row_step;
  cv::Mat sampled(rows, picture.cols, picture.type());
  for (int r = 0; r < rows; ++r) picture.row(r * row_step).copyTo(sampled.row(r));
  return sampled;
}

bool same_bytes(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && std::memcmp(a.data, b.data, a.total() * a.elemSize()) == 0;
}

// Means over blocks: the noise of single pixels is gone.
std::vector<std::uint8_t> sorted_blocks(const cv::Mat& rows) {
  cv::Mat blocks;
  cv::resize(rows, blocks, block_grid, 0.0, 0.0, cv::INTER_AREA);
  std::vector<std::uint8_t> levels(blocks.data, blocks.data + blocks.total() * blocks.elemSize());
  std::sort(levels.begin(), levels.end());
  return levels;
}

// "0.4 %".
std::string percent(double share) {
  const long tenths = std::lround(1000.0 * share);
  return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " %";
}

double share_above(const cv::Mat& rows, double level) {
  const cv::Mat bright = rows.reshape(1) >= level * full_scale;
  return static_cast<double>(cv::countNonZero(bright)) / static_cast<double>(bright.total());
}

}  // namespace

const char* to_string(PictureFault fault) {
  switch (fault) {
    case PictureFault::black:
      return "black";
    case PictureFault::saturated:
      return "saturated";
    case PictureFault::frozen:
      return "frozen";
  }
  return "unknown";
}

std::string PictureVerdict::describe() const {
  const std::string range = percent(dark_block) + " to " + percent(bright_block) + " of full scale";
  if (!fault) return "levels from " + range + ", " + percent(saturated_share) + " saturated";
  switch (*fault) {
    case PictureFault::black:
      return "black: the whole picture lies at " + range;
    case PictureFault::saturated:
      return "saturated: " + percent(saturated_share) + " of the picture is at full scale";
    case PictureFault::frozen:
      break;
  }
  return "frozen: byte for byte the picture before";
}

PictureVerdict PictureCheck::check(const cv::Mat& picture) {
  assert(!picture.empty() && picture.depth() == CV_8U);
  cv::Mat rows = sampled_rows(picture);
  const auto levels = sorted_blocks(rows);

  PictureVerdict verdict;
  verdict.dark_block = levels[levels.size() / 50] / full_scale;
  verdict.bright_block = levels[levels.size() - 1 - levels.size() / 50] / full_scale;
  verdict.saturated_share = share_above(rows, limits_.bright_level);

  const bool dark = verdict.bright_block <= limits_.dark_level;
  const bool flat = verdict.bright_block - verdict.dark_block <= limits_.flat_range;
  if (dark && flat) {
    verdict.fault = PictureFault::black;
  } else if (verdict.saturated_share >= limits_.saturated_share) {
    verdict.fault = PictureFault::saturated;
  } else if (same_bytes(rows, last_rows_)) {
    verdict.fault = PictureFault::frozen;
  }
  last_rows_ = rows;
  return verdict;
}

}  // namespace hogline::vision
