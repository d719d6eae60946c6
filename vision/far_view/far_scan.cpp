#include "vision/far_view/far_scan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "vision/detect/granite.hpp"

namespace hogline::vision {
namespace {

constexpr double grip_height_m = 0.07;  // over the handle's rim
constexpr float least_body = 0.30F;     // share of granite below a handle; nearer stones may hide the rest
constexpr float least_score = 0.15F;
constexpr double least_half_width_px = 6.0;  // smaller stones are not told from specks
constexpr int white_run = 8;                 // steps that share their white

}  // namespace

FarScan::Row FarScan::plan_row(const StonePicture& picture, const StoneArea& area, int y) const {
  const SheetCamera& camera = picture.camera;
  const StoneShape& shape = picture.shape;
  const double z_m = shape.handle_height_m;
  const double width = picture.bgr.cols;
  Row row;
  const auto left = camera.plane_at({0.0, static_cast<double>(y)}, z_m);
  const auto right = camera.plane_at({width - 1.0, static_cast<double>(y)}, z_m);
  if (!left || !right || !(right->x() > left->x())) return row;
  const Eigen::Vector2d middle = 0.5 * (*left + *right);
  if (middle.y() > area.max_y_m || middle.y() < area.min_y_m) return row;
  const Eigen::Vector3d eye = picture.eye();
  const Bearing bearing = bearing_of(middle, eye);
  const auto centre = camera.project({middle.x(), middle.y(), z_m});
  const auto side = camera.project(body_outline_point(middle, shape, eye, 0.0));
  const auto begin = camera.project(
      circle_point(middle, bearing, shape.handle_radius_m, z_m - shape.handle_thickness_m, -0.5 * std::numbers::pi));
  const auto foot = camera.project(body_outline_point(middle, shape, eye, -0.5 * std::numbers::pi));
  const auto grip = camera.project({middle.x(), middle.y(), z_m + grip_height_m});
  if (!centre || !side || !begin || !foot || !grip) return row;
  const auto in_steps = [](double px) { return static_cast<int>(std::lround(px / step_px)); };
  row.half_width_px = std::abs(side->x() - centre->x());
  row.range_m = bearing.range_m;
  if (row.half_width_px < least_half_width_px) return row;
  row.half_width = in_steps(row.half_width_px);
  row.granite_top = in_steps(begin->y() - centre->y());
  row.foot = std::max(row.granite_top + 1, in_steps(foot->y() - centre->y()));
  row.above = std::min(-1, in_steps(grip->y() - centre->y()));
  if (2 * row.half_width >= margin) return row;
  const double per_step = step_px * (right->x() - left->x()) / (width - 1.0);
  const int columns = picture.bgr.cols / step_px;
  row.first = std::clamp(static_cast<int>(std::ceil((-area.half_width_m - left->x()) / per_step)), 0, columns);
  row.last = std::clamp(static_cast<int>(std::floor((area.half_width_m - left->x()) / per_step)) + 1, 0, columns);
  row.seen = row.first < row.last;
  return row;
}

// Sizes change slowly from row to row: some rows share their plan.
void FarScan::plan_rows(const StonePicture& picture, const StoneArea& area, const Part& part) {
  const int rows = picture.bgr.rows / step_px;
  const double z_m = picture.shape.handle_height_m;
  const auto farthest = picture.camera.project({0.0, area.max_y_m, z_m});
  const int top = farthest ? std::clamp(static_cast<int>(farthest->y() / step_px) - 2, 0, rows) : 0;
  first_row_ = top + (rows - top) * part.number / part.count;
  last_row_ = top + (rows - top) * std::min(part.number + part.parts, part.count) / part.count;
  rows_.assign(static_cast<std::size_t>(rows), {});
  base_row_ = last_row_;
  int end = first_row_;
  for (int r = first_row_; r < last_row_; r += planned_together) {
    const Row row = plan_row(picture, area, std::min(r + planned_together / 2, rows - 1) * step_px);
    for (int i = r; i < std::min(r + planned_together, last_row_); ++i) rows_[static_cast<std::size_t>(i)] = row;
    if (!row.seen) continue;
    base_row_ = std::min(base_row_, r + row.above);
    end = std::max(end, std::min(r + planned_together, last_row_) + 2 * row.foot + 2);
  }
  granite_.create(std::max(1, end - base_row_), picture.bgr.cols / step_px + 2 * margin, CV_8UC1);
}

// In steps, 1 where the picture may show granite; nothing of it beyond the picture.
void FarScan::find_granite(const StonePicture& picture, const cv::Mat& twice) {
  const int columns = picture.bgr.cols / step_px;
  granite_.setTo(0);
  const int first = std::max(0, base_row_);
  const int last = std::min(picture.bgr.rows / step_px, base_row_ + granite_.rows);
  for (int r = first; r < last; ++r) {
    const int y = step_px * r;
    std::uint8_t* out = granite_.ptr<std::uint8_t>(r - base_row_) + margin;
    const std::uint8_t* upper = twice.ptr<std::uint8_t>(2 * y);
    const std::uint8_t* lower = twice.ptr<std::uint8_t>(2 * y + 1);
    for (int begin = 0; begin < columns; begin += white_run) {
      const int end = std::min(begin + white_run, columns);
      const auto white = picture.ice.at(step_px * (begin + end) / 2, y);
      const std::array<float, 3> scale{1.0F / white[0], 1.0F / white[1], 1.0F / white[2]};
      for (int c = begin; c < end; ++c) {
        const int at = 6 * step_px * c;
        const auto light = [&](int k) {
          const int sum = upper[at + k] + upper[at + k + 3] + lower[at + k] + lower[at + k + 3];
          const auto mean = static_cast<std::uint8_t>((sum + 2) / 4);
          return picture.response.linear(mean) * scale[static_cast<std::size_t>(k)];
        };
        out[c] = may_be_granite(light(0), light(1), light(2)) ? 1 : 0;
      }
    }
  }
  cv::integral(granite_, sums_, CV_32S);
}

// Of granite, in steps of the picture; ends are exclusive.
float FarScan::share(int left, int top, int right, int bottom) const {
  const int area = std::max(1, (right - left) * (bottom - top));
  const int* upper = sums_.ptr<int>(std::clamp(top - base_row_, 0, granite_.rows));
  const int* lower = sums_.ptr<int>(std::clamp(bottom - base_row_, 0, granite_.rows));
  const int count = lower[right + margin] - lower[left + margin] - upper[right + margin] + upper[left + margin];
  return static_cast<float>(count) / static_cast<float>(area);
}

// Granite where the body is, none beside it, below it and where handle and grip are.
float FarScan::score(const Row& row, int c, int r) const {
  const int side = std::max(1, static_cast<int>(0.75F * static_cast<float>(row.half_width)));
  const int top = r + row.granite_top;
  const int bottom = r + std::max(row.granite_top + 1, static_cast<int>(0.9F * static_cast<float>(row.foot)));
  const float body = share(c - side, top, c + side + 1, bottom);
  if (body < least_body) return -1.0F;
  const int beside = row.half_width + 1;
  const int reach = beside + std::max(1, row.half_width / 2);
  const float left = share(c - reach, top, c - beside, bottom);
  const float right = share(c + beside + 1, top, c + reach + 1, bottom);
  const int below = r + row.foot + 1;
  const float under = share(c - side, below, c + side + 1, below + std::max(1, (row.foot - row.granite_top) / 2));
  const int half_handle = std::max(1, row.half_width / 3);
  const float handle = share(c - half_handle, r + row.above, c + half_handle + 1, r + 1);
  // Beside and over it other stones may stand.
  return body - 0.5F * std::min(left, right) - 0.2F * std::max(left, right) - 0.3F * under - 0.5F * handle;
}

const std::vector<FarPlace>& FarScan::find(const StonePicture& picture, const cv::Mat& twice, const StoneArea& area,
                                           const Part& part) {
  places_.clear();
  plan_rows(picture, area, part);
  if (base_row_ >= last_row_) return places_;
  find_granite(picture, twice);

  const int columns = picture.bgr.cols / step_px;
  const int rows = last_row_;
  scores_.create(static_cast<int>(rows_.size()), columns, CV_32FC1);
  scores_.rowRange(first_row_, last_row_).setTo(-1.0F);
  for (int r = first_row_; r < rows; ++r) {
    const Row& row = rows_[static_cast<std::size_t>(r)];
    if (!row.seen) continue;
    for (int c = row.first; c < row.last; ++c) scores_.at<float>(r, c) = score(row, c, r);
  }

  // The best of each neighbourhood of a third of a stone.
  for (int r = first_row_; r < rows; ++r) {
    const Row& row = rows_[static_cast<std::size_t>(r)];
    const int reach_x = std::max(1, row.half_width / 3);
    const int reach_y = std::max(1, (row.foot - row.granite_top) / 3);
    for (int c = row.first; row.seen && c < row.last; ++c) {
      const float here = scores_.at<float>(r, c);
      if (here < least_score) continue;
      bool best = true;
      for (int y = std::max(first_row_, r - reach_y); best && y <= std::min(rows - 1, r + reach_y); ++y) {
        const float* line = scores_.ptr<float>(y);
        for (int x = std::max(0, c - reach_x); best && x <= std::min(columns - 1, c + reach_x); ++x) {
          const bool before = y < r || (y == r && x < c);
          best = before ? line[x] < here : line[x] <= here;
        }
      }
      if (best) places_.push_back({cv::Point2d(step_px * c, step_px * r), row.half_width_px, row.range_m, here});
    }
  }
  std::sort(places_.begin(), places_.end(), [](const FarPlace& a, const FarPlace& b) {
    return a.score != b.score       ? a.score > b.score
           : a.pixel.y != b.pixel.y ? a.pixel.y < b.pixel.y
                                    : a.pixel.x < b.pixel.x;
  });
  if (places_.size() > most_places) places_.resize(most_places);
  return places_;
}

cv::Rect mark_for_votes(cv::Point2d centre, double half_width_px, cv::Mat& centres) {
  const int reach_x = 1 + static_cast<int>(half_width_px / 10.0);
  const int reach_y = 1 + static_cast<int>(half_width_px / 14.0);
  const int x = static_cast<int>(centre.x / 2.0);
  const int y = static_cast<int>(centre.y / 2.0);
  const cv::Rect box =
      cv::Rect(x - reach_x, y - reach_y, 2 * reach_x + 1, 2 * reach_y + 1) & cv::Rect({0, 0}, centres.size());
  if (!box.empty()) centres(box).setTo(255);
  return box;
}

}  // namespace hogline::vision
