#include "vision/fit/foreground.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vision/fit/unlike_stone.hpp"

namespace hogline::vision {
namespace {

constexpr double over_rim_m = 0.10;  // a grip ends below it
constexpr double leg_m = 0.30;
constexpr int beyond_px = 3;          // the stone's own blur and shadow
constexpr double ice_light = 0.72;    // of white ice: brighter is ice or its glare
constexpr double ice_colour = 0.15;   // spread of the channels: more is no ice in shade
constexpr double as_granite = 0.40;   // of granite's light: nearer to it can not be told from it
constexpr double alike = 0.05;        // noise
constexpr double alike_share = 0.12;  // of the light
constexpr double follow = 0.3;        // how fast the run's colour follows what it meets
constexpr int blur_columns = 2;
constexpr double most_ice = 0.3;  // of what is no stone's: else nobody stands there
constexpr int fewest_rows = 2;

double brightness(const Light& light) { return 0.114 * light[0] + 0.587 * light[1] + 0.299 * light[2]; }

struct Extent {
  int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
  void add(const Eigen::Vector2d& p) {
    left = std::min(left, static_cast<int>(std::floor(p.x())));
    right = std::max(right, static_cast<int>(std::ceil(p.x())));
    top = std::min(top, static_cast<int>(std::floor(p.y())));
    bottom = std::max(bottom, static_cast<int>(std::ceil(p.y())));
  }
};

cv::Rect covered_by(const StonePicture& picture, const Eigen::Vector2d& place) {
  const Bearing bearing = bearing_of(place, picture.eye());
  if (bearing.range_m < 2.0 * picture.shape.body_radius_m) return {};
  Extent all;
  for (int i = 0; i < 12; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 12.0;
    for (const Eigen::Vector3d& p : {body_outline_point(place, picture.shape, picture.eye(), angle),
                                     circle_point(place, bearing, picture.shape.handle_radius_m,
                                                  picture.shape.handle_height_m + over_rim_m, angle)}) {
      const auto pixel = picture.camera.project(p);
      if (!pixel) return {};
      all.add(*pixel);
    }
  }
  const cv::Rect area(cv::Point(all.left - blur_columns, all.top - beyond_px),
                      cv::Point(all.right + blur_columns + 1, all.bottom + beyond_px + 1));
  return area & cv::Rect(0, 0, picture.bgr.cols, picture.bgr.rows);
}

// Away from the picture's middle what is upright leans: columns to a row.
double lean_at(const StonePicture& picture, const Eigen::Vector2d& place) {
  const auto foot = picture.camera.project({place.x(), place.y(), 0.0});
  const auto head = picture.camera.project({place.x(), place.y(), leg_m});
  if (!foot || !head || foot->y() - head->y() < 1.0) return 0.0;
  return (head->x() - foot->x()) / (head->y() - foot->y());
}

bool may_be_ice(const Light& light) {
  return brightness(light) > ice_light && light.maxCoeff() - light.minCoeff() < ice_colour;
}

}  // namespace

Foreground::Foreground(const StonePicture& picture, const Eigen::Vector2d& place, const Light& granite,
                       const TeamHues& teams, By by)
    : by_(by), granite_(granite), teams_(teams) {
  if (by == By::run) {
    find_runs(picture, place);
  } else {
    find_unlike(picture, place);
  }
}

void Foreground::find_unlike(const StonePicture& picture, const Eigen::Vector2d& place) {
  const UnlikeStone seen = unlike_stone(picture, place, granite_, teams_);
  area_ = seen.area;
  unlike_ = seen.unlike;
  share_ = seen.ice < most_ice ? seen.share : 0.0;
}

void Foreground::find_runs(const StonePicture& picture, const Eigen::Vector2d& place) {
  area_ = covered_by(picture, place);
  if (area_.empty()) return;
  lean_ = lean_at(picture, place);
  const PatchSource source(picture, place);
  const auto columns = static_cast<std::size_t>(area_.width);
  std::vector<int> above(columns);
  std::vector<int> below(columns);
  int hidden = 0;
  for (std::size_t c = 0; c < columns; ++c) {
    const int column = static_cast<int>(c);
    above[c] = end_of_run(source, column, area_.y, area_.br().y, 1);
    below[c] = end_of_run(source, column, area_.br().y - 1, area_.y - 1, -1) + 1;
    hidden += above[c] > area_.y + beyond_px || below[c] < area_.br().y - beyond_px ? 1 : 0;
  }
  share_ = static_cast<double>(hidden) / static_cast<double>(columns);
  above_ = above;
  below_ = below;
  for (std::size_t c = 0; c < columns; ++c) {
    const std::size_t last = std::min(columns - 1, c + blur_columns);
    for (std::size_t k = c < blur_columns ? 0 : c - blur_columns; k <= last; ++k) {
      above_[c] = std::max(above_[c], above[k]);
      below_[c] = std::min(below_[c], below[k]);
    }
  }
}

int Foreground::leaned(int y) const { return static_cast<int>(std::lround(lean_ * (y - area_.y - area_.height / 2))); }

bool Foreground::is_like_granite(const Light& light) const {
  return (light - granite_).norm() < as_granite * granite_.norm();
}

bool Foreground::has_a_handles_hue(const Light& light) const {
  return has_a_teams_hue({static_cast<float>(light[2]), static_cast<float>(light[1]), static_cast<float>(light[0])},
                         teams_);
}

// What is over a stone may be its own grip, and what is below its foot is no handle of its own.
int Foreground::end_of_run(const PatchSource& source, int column, int from, int to, int step) const {
  const int last = area_.br().x - 1;
  const auto light_at = [&](int y) -> Light {
    return source.at(std::clamp(area_.x + column + leaned(y), area_.x, last), y).matrix().cast<double>();
  };
  Light run = light_at(from);
  if (may_be_ice(run) || is_like_granite(run) || (step > 0 && has_a_handles_hue(run))) return from;
  int y = from;
  for (; y != to; y += step) {
    const Light light = light_at(y);
    if ((light - run).norm() > alike + alike_share * run.norm()) break;
    run += follow * (light - run);
  }
  if (std::abs(y - from) < beyond_px + fewest_rows) return from;
  return y == to ? y : y + step;
}

bool Foreground::hides(int x, int y) const {
  if (by_ == By::unlike) {
    return area_.contains({x, y}) && unlike_.at<std::uint8_t>(y - area_.y, x - area_.x) != 0;
  }
  const int column = x - leaned(y) - area_.x;
  if (column < 0 || column >= area_.width || share_ == 0.0) return false;
  const auto c = static_cast<std::size_t>(column);
  return y < above_[c] || y >= below_[c];
}

}  // namespace hogline::vision
