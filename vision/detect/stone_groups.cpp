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
constexpr float least_granite = 0.08F;       // share of the body below a handle; nearer stones may hide the rest
constexpr float most_handle_granite = 0.6F;  // share of the handle that may look like granite
constexpr float big_px = 24.0F;              // half the width of stones for which every fourth pixel is enough
constexpr float margin_px = 4.0F;

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

}  // namespace

StoneGroupFinder::StoneGroupFinder(const CameraSetup& setup, const StoneShape& shape)
    : columns_((setup.intrinsics.width_px + block_px - 1) / block_px), top_(GroundView(setup).first_row(range_m) & ~3) {
  const SheetCamera camera(Lens(setup.intrinsics), eMb(PlanarPose{}) * bMc(setup.mount), setup.ice);
  const int rows = (setup.intrinsics.height_px + block_px - 1) / block_px;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns_; ++c) {
      const Eigen::Vector2d middle((c + 0.5) * block_px, (r + 0.5) * block_px);
      extents_.push_back(extent_at(camera, middle, shape));
    }
  }
  choose_bands(setup.intrinsics.height_px / 4 * 4);
}

void StoneGroupFinder::choose_bands(int bottom) {
  const int split = std::min(first_big_row(), bottom);
  bands_ = {{{top_, split, 2, 0}, {split, bottom, 4, 0}}};
  for (std::size_t i = 0; i < extents_.size(); ++i) {
    Extent& e = extents_[i];
    const int y = static_cast<int>(i) / columns_ * block_px;
    Band& band = bands_[y < split ? 0 : 1];
    e.choose_rectangles(static_cast<float>(band.step));
    if (e.seen) band.below = std::max(band.below, static_cast<int>(e.below) / 4 * 4 + 4);
  }
}

// From here down every stone is big; a multiple of four rows below the top.
int StoneGroupFinder::first_big_row() const {
  std::size_t small = 0;
  for (std::size_t i = 0; i < extents_.size(); ++i) {
    if (extents_[i].seen && extents_[i].half_width < big_px) small = i / static_cast<std::size_t>(columns_) + 1;
  }
  return std::max(top_, (static_cast<int>(small) * block_px - top_) / 4 * 4 + top_);
}

// What must be granite below the handle, and what must not be, in steps of so many pixels.
void StoneGroupFinder::Extent::choose_rectangles(float step) {
  if (!seen) return;
  const auto in_steps = [step](float px) { return std::min(margin - 1, static_cast<int>(px / step)); };
  const int side = in_steps(0.7F * half_width);
  body = {-side, side + 1, in_steps(granite_top), in_steps(granite_top + 0.85F * (below - granite_top)) + 1};
  least_body = static_cast<int>(std::ceil(least_granite * static_cast<float>(body.area())));
  const int handle_side = in_steps(0.4F * half_width);
  const int depth = in_steps(0.5F * granite_top);
  handle = {-handle_side, handle_side + 1, -depth, depth + 1};
  most_handle = static_cast<int>(most_handle_granite * static_cast<float>(handle.area()));
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
  e.below = static_cast<float>(foot->y() - pixel.y());
  e.granite_top = static_cast<float>(begin->y() - pixel.y());
  e.above = static_cast<float>(grip->y() - pixel.y());
  return e;
}

StoneGroups StoneGroupFinder::find(const cv::Mat& bgr, const WhiteLight& ice, const ResponseCurve& response) {
  StoneGroups groups;
  begin(bgr, groups);
  for (const Band& band : bands_) {
    if (band.bottom <= band.top) continue;
    find_granite(band, bgr, ice, response);
    cv::integral(granite_, sums_, CV_32S);
    mark_centres(band, bgr.cols, groups.centres);
  }
  groups.boxes = boxes_of(bgr.size());
  return groups;
}

void StoneGroupFinder::begin(const cv::Mat& bgr, StoneGroups& groups) {
  groups.top = top_;
  groups.centres.create((bgr.rows - top_) / 2, bgr.cols / 2, CV_8UC1);
  groups.centres.setTo(0);
  cells_.create((bgr.rows - top_) / cell_px + 1, bgr.cols / cell_px + 1, CV_8UC1);
  cells_.setTo(0);
}

StoneGroups StoneGroupFinder::find_unexplained(const cv::Mat& bgr, const WhiteLight& ice, const ResponseCurve& response,
                                               const GroupSearch& search) {
  StoneGroups groups;
  begin(bgr, groups);
  for (Band band : bands_) {
    band.top = std::max(band.top, search.first_row / 4 * 4);
    band.bottom = std::min(band.bottom, search.last_row / 4 * 4);
    if (band.bottom <= band.top) continue;
    find_granite(band, bgr, ice, response);
    for (const auto& outline : search.explained) leave_out(band, outline);
    cv::integral(granite_, sums_, CV_32S);
    mark_centres(band, bgr.cols, groups.centres);
  }
  return groups;
}

void StoneGroupFinder::leave_out(const Band& band, const std::vector<cv::Point>& outline) {
  std::vector<cv::Point> steps;
  for (const cv::Point& p : outline) {
    steps.emplace_back(p.x / band.step + margin, (p.y - band.top) / band.step + margin);
  }
  cv::fillConvexPoly(granite_, steps, cv::Scalar::all(0));
}

// A row of a band costs by its steps, across and down.
int StoneGroupFinder::part_begins(int number, int count) const {
  double all = 0.0;
  for (const Band& b : bands_) all += std::max(0, b.bottom - b.top) / static_cast<double>(b.step * b.step);
  double wanted = all * number / count;
  for (const Band& b : bands_) {
    const double rows = std::max(0, b.bottom - b.top);
    const double cost = rows / (b.step * b.step);
    if (wanted < cost) return b.top + static_cast<int>(wanted * b.step * b.step) / 4 * 4;
    wanted -= cost;
  }
  return bands_[1].bottom;
}

void StoneGroupFinder::find_whites(const WhiteLight& ice, const ResponseCurve& response, int columns, int y) {
  whites_.clear();
  for (int x = 0; x < columns; x += white_px) {
    const auto white = ice.at(x + white_px / 2, y + white_px / 2);
    White w{{1.0F / white[0], 1.0F / white[1], 1.0F / white[2]}};
    int high = 256;
    while (w.light_level < high) {
      const int middle = (w.light_level + high) / 2;
      const bool dark = response.linear(static_cast<std::uint8_t>(middle)) * w.scale[1] < lightest_granite;
      (dark ? w.light_level : high) = dark ? middle + 1 : middle;
    }
    whites_.push_back(w);
  }
}

// In steps of `step` pixels, 1 where the mean of four pixels may be granite; with a margin of nothing about it.
void StoneGroupFinder::find_granite(const Band& band, const cv::Mat& bgr, const WhiteLight& ice,
                                    const ResponseCurve& response) {
  const int rows = (std::min(band.bottom + band.below, bgr.rows & ~3) - band.top) / band.step;
  const int columns = bgr.cols / band.step;
  granite_.create(rows + 2 * margin, columns + 2 * margin, CV_8UC1);
  granite_.setTo(0);
  const int run = white_px / band.step;  // columns that share their white, and so many rows
  for (int r = 0; r < rows; ++r) {
    const int y = band.top + band.step * r;
    if (band.step * r % white_px == 0) find_whites(ice, response, bgr.cols, y);
    std::uint8_t* out = granite_.ptr<std::uint8_t>(r + margin) + margin;
    for (int begin = 0; begin < columns; begin += run) {
      const int end = std::min(begin + run, columns);
      if (!extent(band.step * begin, y).seen && !extent(band.step * end - 1, y).seen) continue;
      const White white = whites_[static_cast<std::size_t>(begin / run)];
      const std::uint8_t* upper = bgr.ptr<std::uint8_t>(y) + 3 * band.step * begin;
      const std::uint8_t* lower = bgr.ptr<std::uint8_t>(y + 1) + 3 * band.step * begin;
      for (int c = begin; c < end; ++c, upper += 3 * band.step, lower += 3 * band.step) {
        const auto level = [&](int k) { return (upper[k] + upper[k + 3] + lower[k] + lower[k + 3] + 2) / 4; };
        // Most of it is ice: its green alone says so.
        if (level(1) >= white.light_level) continue;
        const auto light = [&](int k) {
          return response.linear(static_cast<std::uint8_t>(level(k))) * white.scale[static_cast<std::size_t>(k)];
        };
        out[c] = may_be_granite(light(0), light(1), light(2)) ? 1 : 0;
      }
    }
  }
}

// Marks are of half the picture's size, cells of an eighth.
void StoneGroupFinder::mark_centres(const Band& band, int columns, cv::Mat& centres) {
  const int size = band.step / 2;
  const int row_length = static_cast<int>(sums_.step1());
  for (int y = band.top; y < band.bottom; y += band.step) {
    const int* sums = sums_.ptr<int>((y - band.top) / band.step + margin) + margin;
    for (int begin = 0; begin < columns / band.step; begin += block_px / band.step) {
      const Extent& e = extent(band.step * begin, y);
      const int end = std::min(begin + block_px / band.step, columns / band.step);
      // Over ice there is no granite for any of a block's places.
      Rectangle of_all = e.body;
      of_all.right += end - begin - 1;
      if (!e.seen || of_all.count(sums + begin, row_length) < e.least_body) continue;
      std::array<int, block_px> in_body;
      std::array<int, block_px> in_handle;
      e.body.count(sums + begin, row_length, end - begin, in_body.data());
      e.handle.count(sums + begin, row_length, end - begin, in_handle.data());
      for (int c = begin; c < end; ++c) {
        const auto i = static_cast<std::size_t>(c - begin);
        if (in_body[i] < e.least_body || in_handle[i] > e.most_handle) continue;
        for (int row = 0; row < size; ++row) {
          std::uint8_t* out = centres.ptr<std::uint8_t>((y - top_) / 2 + row) + size * c;
          std::fill(out, out + size, std::uint8_t{255});
        }
        cells_.at<std::uint8_t>((y - top_) / cell_px, band.step * c / cell_px) = 255;
      }
    }
  }
}

std::vector<cv::Rect> StoneGroupFinder::boxes_of(cv::Size picture) const {
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat middles;
  const int count = cv::connectedComponentsWithStats(cells_, labels, stats, middles, 8, CV_32S);
  std::vector<cv::Rect> boxes;
  for (int i = 1; i < count; ++i) {
    const cv::Rect cells(stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                         stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT));
    const int y0 = top_ + cell_px * cells.y;
    const int y1 = std::min(top_ + cell_px * cells.br().y, picture.height) - 1;
    const Extent& low = extent(std::min(cell_px * cells.x + cell_px * cells.width / 2, picture.width - 1), y1);
    const auto side = static_cast<int>(low.half_width + margin_px);
    const int above = static_cast<int>(std::abs(low.above) + margin_px);
    const int below = static_cast<int>(low.below + margin_px);
    const cv::Rect whole(cv::Point(cell_px * cells.x - side, y0 - above),
                         cv::Point(cell_px * cells.br().x + side, y1 + below));
    boxes.push_back(whole & cv::Rect({0, 0}, picture));
  }
  return merged(boxes);
}

}  // namespace hogline::vision
