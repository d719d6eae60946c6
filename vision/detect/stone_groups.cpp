#include "vision/detect/stone_groups.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "vision/detect/granite.hpp"
#include "vision/detect/ground_view.hpp"

namespace hogline::vision {
namespace {

constexpr double range_m = 13.0;             // from the body: the hog line and a little more
constexpr double half_width_m = 4.5;         // to the side of the body: the sheet, off its middle and turned
constexpr double grip_height_m = 0.07;       // over the handle's rim
constexpr double least_granite = 0.12;       // share of the body below a handle; nearer stones may hide the rest
constexpr double most_handle_granite = 0.6;  // share of the handle that may look like granite
constexpr float big_px = 16.0F;              // half the width of a stone that is searched in steps
constexpr float margin_px = 4.0F;

cv::Rect all_of(const cv::Mat& picture) { return {0, 0, picture.cols, picture.rows}; }

// Overlapping boxes become one, until none overlap.
std::vector<cv::Rect> merged(std::vector<cv::Rect> boxes) {
  for (bool again = true; again;) {
    again = false;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      for (std::size_t j = i + 1; j < boxes.size();) {
        if ((boxes[i] & boxes[j]).area() > 0) {
          boxes[i] |= boxes[j];
          boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(j));
          again = true;
        } else {
          ++j;
        }
      }
    }
  }
  return boxes;
}

// Of a rectangle about (x, y): `side` to the left and right, from `above` to `below`.
double share_in(const cv::Mat& sums, int x, int y, float side, float above, float below) {
  const int x0 = std::clamp(x - static_cast<int>(side), 0, sums.cols - 1);
  const int x1 = std::clamp(x + static_cast<int>(side) + 1, 0, sums.cols - 1);
  const int y0 = std::clamp(y + static_cast<int>(above), 0, sums.rows - 1);
  const int y1 = std::clamp(y + static_cast<int>(below) + 1, 0, sums.rows - 1);
  const int area = (x1 - x0) * (y1 - y0);
  if (area <= 0) return 0.0;
  const int* upper = sums.ptr<int>(y0);
  const int* lower = sums.ptr<int>(y1);
  return static_cast<double>(lower[x1] - lower[x0] - upper[x1] + upper[x0]) / area;
}

}  // namespace

StoneGroupFinder::StoneGroupFinder(const CameraSetup& setup, const StoneShape& shape)
    : columns_((setup.intrinsics.width_px + block_px - 1) / block_px), top_(GroundView(setup).first_row(range_m) & ~1) {
  const SheetCamera camera(Lens(setup.intrinsics), eMb(PlanarPose{}) * bMc(setup.mount), setup.ice);
  const int rows = (setup.intrinsics.height_px + block_px - 1) / block_px;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns_; ++c) {
      const Eigen::Vector2d middle((c + 0.5) * block_px, (r + 0.5) * block_px);
      extents_.push_back(extent_at(camera, middle, shape));
    }
  }
}

StoneGroupFinder::Extent StoneGroupFinder::extent_at(const SheetCamera& camera, const Eigen::Vector2d& pixel,
                                                     const StoneShape& shape) const {
  const auto place = camera.plane_at(pixel, shape.handle_height_m);
  if (!place) return {};
  const Eigen::Vector3d eye = camera.eMc().translation();
  const Bearing bearing = bearing_of(*place, eye);
  if (std::abs(place->x()) > half_width_m || bearing.range_m > 1.2 * range_m ||
      bearing.range_m < 2.0 * shape.body_radius_m)
    return {};
  const double granite_m = shape.handle_height_m - shape.handle_thickness_m;
  const auto side = camera.project(body_outline_point(*place, shape, eye, 0.0));
  const auto begin =
      camera.project(circle_point(*place, bearing, shape.handle_radius_m, granite_m, -0.5 * std::numbers::pi));
  const auto foot = camera.project(body_outline_point(*place, shape, eye, -0.5 * std::numbers::pi));
  const auto grip = camera.project({place->x(), place->y(), shape.handle_height_m + grip_height_m});
  if (!side || !begin || !foot || !grip) return {};
  Extent e;
  e.seen = true;
  e.half_width = static_cast<float>(std::abs(side->x() - pixel.x()));
  e.side = 0.7F * e.half_width;
  e.granite_top = static_cast<float>(begin->y() - pixel.y());
  e.below = static_cast<float>(foot->y() - pixel.y());
  e.granite_bottom = e.granite_top + 0.85F * (e.below - e.granite_top);
  e.handle_side = 0.4F * e.half_width;
  e.handle_depth = 0.5F * e.granite_top;
  e.above = static_cast<float>(grip->y() - pixel.y());
  return e;
}

StoneGroups StoneGroupFinder::find(const cv::Mat& bgr, const WhiteLight& ice, const ResponseCurve& response) const {
  StoneGroups groups;
  groups.top = top_;
  groups.centres = possible_centres(granite(bgr, ice, response));
  groups.boxes = boxes_of(groups.centres, bgr.size());
  return groups;
}

// At half size, 1 where a pixel may be granite.
cv::Mat StoneGroupFinder::granite(const cv::Mat& bgr, const WhiteLight& ice, const ResponseCurve& response) const {
  const cv::Mat lower = bgr.rowRange(top_, bgr.rows);
  cv::Mat half;
  cv::resize(lower, half, cv::Size(lower.cols / 2, lower.rows / 2), 0.0, 0.0, cv::INTER_AREA);
  cv::Mat mask(half.size(), CV_8UC1);
  constexpr int run = 16;
  for (int r = 0; r < half.rows; ++r) {
    const std::uint8_t* in = half.ptr<std::uint8_t>(r);
    std::uint8_t* out = mask.ptr<std::uint8_t>(r);
    for (int begin = 0; begin < half.cols; begin += run) {
      const int row = top_ + 2 * r;
      const int last = std::min(2 * (begin + run), bgr.cols) - 1;
      if (!extent(2 * begin, row).seen && !extent(last, row).seen) {
        std::fill(out + begin, out + std::min(begin + run, half.cols), std::uint8_t{0});
        continue;
      }
      const auto white = ice.at(2.0 * begin + run, row);
      const std::array<float, 3> scale{1.0F / white[0], 1.0F / white[1], 1.0F / white[2]};
      for (int c = begin; c < std::min(begin + run, half.cols); ++c) {
        const float b = response.linear(in[3 * c]) * scale[0];
        const float g = response.linear(in[3 * c + 1]) * scale[1];
        const float red = response.linear(in[3 * c + 2]) * scale[2];
        out[c] = may_be_granite(b, g, red) ? 1 : 0;
      }
    }
  }
  return mask;
}

// Where stones are big every second pixel in both directions, for itself and its neighbours.
cv::Mat StoneGroupFinder::possible_centres(const cv::Mat& granite) const {
  cv::Mat sums;
  cv::integral(granite, sums, CV_32S);
  cv::Mat centres(granite.size(), CV_8UC1, cv::Scalar(0));
  for (int r = 0; r < granite.rows; ++r) {
    for (int c = 0; c < granite.cols;) {
      const Extent& e = extent(2 * c, top_ + 2 * r);
      const int step = e.seen && e.half_width > big_px ? 2 : 1;
      const bool wanted = e.seen && (step == 1 || r % 2 == 0);
      if (wanted && may_be_centre(e, sums, c, r)) centres(cv::Rect(c, r, step, step) & all_of(centres)).setTo(255);
      c += step;
    }
  }
  return centres;
}

bool StoneGroupFinder::may_be_centre(const Extent& e, const cv::Mat& sums, int c, int r) {
  const double body = share_in(sums, c, r, 0.5F * e.side, 0.5F * e.granite_top, 0.5F * e.granite_bottom);
  if (body < least_granite) return false;
  const double handle = share_in(sums, c, r, 0.5F * e.handle_side, -0.5F * e.handle_depth, 0.5F * e.handle_depth);
  return handle <= most_handle_granite;
}

std::vector<cv::Rect> StoneGroupFinder::boxes_of(const cv::Mat& centres, cv::Size picture) const {
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat middles;
  const int count = cv::connectedComponentsWithStats(centres, labels, stats, middles, 8, CV_32S);
  std::vector<cv::Rect> boxes;
  for (int i = 1; i < count; ++i) {
    const cv::Rect half(stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                        stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT));
    const int y0 = top_ + 2 * half.y;
    const int y1 = std::min(top_ + 2 * half.br().y, picture.height) - 1;
    const Extent& low = extent(std::min(2 * half.x + half.width, picture.width - 1), y1);
    const auto side = static_cast<int>(low.half_width + margin_px);
    const int above = static_cast<int>(std::abs(low.above) + margin_px);
    const int below = static_cast<int>(low.below + margin_px);
    const cv::Rect whole(cv::Point(2 * half.x - side, y0 - above), cv::Point(2 * half.br().x + side, y1 + below));
    boxes.push_back(whole & cv::Rect({0, 0}, picture));
  }
  return merged(boxes);
}

}  // namespace hogline::vision
