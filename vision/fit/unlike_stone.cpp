#include "vision/fit/unlike_stone.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace hogline::vision {
namespace {

constexpr int outline_points = 20;
constexpr int shift = 4;              // of outlines' coordinates
constexpr int margin_px = 5;          // about the outlines, for the fit's band
constexpr int widths_in_view = 14;    // of a stone, in what is called near
constexpr double darkest = 0.4;       // of the granite's light: shade,
constexpr double lightest = 1.9;      // and lamps
constexpr double granite_off = 0.25;  // of its light: the rest is another colour
constexpr double noise = 0.03;
constexpr double ice_light = 0.72;   // of white ice: brighter is ice or its glare
constexpr double ice_colour = 0.15;  // spread of the channels: more is no ice in shade

enum Part : std::uint8_t { none, body, plate };

double brightness(const Light& light) { return 0.114 * light[0] + 0.587 * light[1] + 0.299 * light[2]; }

using Outline = std::array<cv::Point2d, outline_points>;

struct Outlines {
  Outline body, under, face;
  bool ok = true;

  Outlines(const StonePicture& picture, const Eigen::Vector2d& place) {
    const StoneShape& shape = picture.shape;
    const Bearing bearing = bearing_of(place, picture.eye());
    ok = bearing.range_m > 2.0 * shape.body_radius_m;
    const double under_m = shape.handle_height_m - shape.handle_thickness_m;
    for (int i = 0; i < outline_points && ok; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / outline_points;
      const auto k = static_cast<std::size_t>(i);
      put(picture, body_outline_point(place, shape, picture.eye(), angle), body[k]);
      put(picture, circle_point(place, bearing, shape.handle_radius_m, under_m, angle), under[k]);
      put(picture, circle_point(place, bearing, shape.handle_radius_m, shape.handle_height_m, angle), face[k]);
    }
  }

  cv::Rect bounds(cv::Size size) const {
    cv::Point2d low = body.front();
    cv::Point2d high = low;
    for (const Outline* outline : {&body, &under, &face}) {
      for (const cv::Point2d& p : *outline) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
      }
    }
    const cv::Rect box(cv::Point(static_cast<int>(low.x) - margin_px, static_cast<int>(low.y) - margin_px),
                       cv::Point(static_cast<int>(high.x) + margin_px + 2, static_cast<int>(high.y) + margin_px + 2));
    return box & cv::Rect({0, 0}, size);
  }

 private:
  void put(const StonePicture& picture, const Eigen::Vector3d& point, cv::Point2d& seen) {
    const auto pixel = picture.camera.project(point);
    ok = ok && pixel;
    if (ok) seen = {pixel->x(), pixel->y()};
  }
};

void fill(cv::Mat& parts, const Outline& outline, cv::Point origin, Part part) {
  std::array<cv::Point, outline_points> points;
  std::transform(outline.begin(), outline.end(), points.begin(), [origin](const cv::Point2d& p) {
    return cv::Point(static_cast<int>(std::lround((p.x - origin.x) * (1 << shift))),
                     static_cast<int>(std::lround((p.y - origin.y) * (1 << shift))));
  });
  cv::fillConvexPoly(parts, points.data(), outline_points, cv::Scalar(part), cv::LINE_8, shift);
}

bool is_inside(const cv::Mat& parts, int x, int y) {
  const std::uint8_t part = parts.at<std::uint8_t>(y, x);
  for (int j = std::max(0, y - 1); j <= std::min(parts.rows - 1, y + 1); ++j) {
    for (int i = std::max(0, x - 1); i <= std::min(parts.cols - 1, x + 1); ++i) {
      if (parts.at<std::uint8_t>(j, i) != part) return false;
    }
  }
  return true;
}

/// The part of each pixel that it shares with its neighbours; else none.
cv::Mat parts_of(const Outlines& outlines, const cv::Rect& area) {
  cv::Mat all(area.size(), CV_8UC1, cv::Scalar(none));
  fill(all, outlines.body, area.tl(), body);
  fill(all, outlines.under, area.tl(), plate);
  fill(all, outlines.face, area.tl(), plate);
  cv::Mat inner(area.size(), CV_8UC1, cv::Scalar(none));
  for (int y = 0; y < all.rows; ++y) {
    for (int x = 0; x < all.cols; ++x) {
      const std::uint8_t part = all.at<std::uint8_t>(y, x);
      if (part != none && is_inside(all, x, y)) inner.at<std::uint8_t>(y, x) = part;
    }
  }
  return inner;
}

bool is_granite(const Light& light, const Light& granite) {
  const double ratio = brightness(light) / std::max(1e-3, brightness(granite));
  if (ratio < darkest || ratio > lightest) return false;
  return (light - ratio * granite).norm() < noise + granite_off * ratio * granite.norm();
}

bool may_be_ice(const Light& light) {
  return brightness(light) > ice_light && light.maxCoeff() - light.minCoeff() < ice_colour;
}

/// Of the two hues the one that more of the plate has.
class PlatesHue {
 public:
  explicit PlatesHue(const TeamHues& teams)
      : hues_{TeamHues{teams.first_rad, teams.first_rad}, TeamHues{teams.second_rad, teams.second_rad}} {}

  void ask(const Light& light) {
    for (std::size_t i = 0; i < 2; ++i) have_[i] += has(light, i) ? 1 : 0;
  }
  bool has(const Light& light) const { return has(light, have_[0] >= have_[1] ? 0 : 1); }

 private:
  bool has(const Light& light, std::size_t which) const {
    const Eigen::Vector3f bgr = light.cast<float>();
    return has_a_teams_hue({bgr[2], bgr[1], bgr[0]}, hues_[which]);
  }

  std::array<TeamHues, 2> hues_;
  std::array<int, 2> have_{};
};

template <typename Visit>
void for_each(const cv::Mat& parts, Part part, const Visit& visit) {
  for (int y = 0; y < parts.rows; ++y) {
    for (int x = 0; x < parts.cols; ++x) {
      if (parts.at<std::uint8_t>(y, x) == part) visit(x, y);
    }
  }
}

/// How many are set in a square about a pixel, from their sums over all that is above and to the left.
int set_about(const cv::Mat& sums, int x, int y, int radius_px) {
  const int left = std::max(0, x - radius_px);
  const int right = std::min(sums.cols - 1, x + radius_px + 1);
  const int top = std::max(0, y - radius_px);
  const int bottom = std::min(sums.rows - 1, y + radius_px + 1);
  return sums.at<int>(bottom, right) - sums.at<int>(top, right) - sums.at<int>(bottom, left) + sums.at<int>(top, left);
}

/// 255 where more than half of what is asked in the square about a pixel is of `some`.
cv::Mat mostly(const cv::Mat& some, const cv::Mat& asked, int radius_px) {
  cv::Mat some_sums;
  cv::Mat asked_sums;
  cv::integral(some, some_sums, CV_32S);
  cv::integral(asked, asked_sums, CV_32S);
  cv::Mat result(some.size(), CV_8UC1);
  for (int y = 0; y < result.rows; ++y) {
    for (int x = 0; x < result.cols; ++x) {
      const int part = set_about(some_sums, x, y, radius_px);
      const int all = set_about(asked_sums, x, y, radius_px);
      result.at<std::uint8_t>(y, x) = 2 * part > all ? 255 : 0;
    }
  }
  return result;
}

}  // namespace

UnlikeStone unlike_stone(const StonePicture& picture, const Eigen::Vector2d& place, const Light& granite,
                         const TeamHues& teams) {
  UnlikeStone seen;
  const Outlines outlines(picture, place);
  if (!outlines.ok) return seen;
  const cv::Rect area = outlines.bounds(picture.bgr.size());
  if (area.empty()) return seen;
  const cv::Mat parts = parts_of(outlines, area);
  const PatchSource source(picture, place);
  const auto light_at = [&](int x, int y) -> Light {
    return source.at(area.x + x, area.y + y).matrix().cast<double>();
  };

  PlatesHue hue(teams);
  for_each(parts, plate, [&](int x, int y) { hue.ask(light_at(x, y)); });
  cv::Mat off(area.size(), CV_8UC1, cv::Scalar(0));
  int ice = 0;
  const auto judge = [&](int x, int y, bool is_stone) {
    if (is_stone) return;
    off.at<std::uint8_t>(y, x) = 1;
    ice += may_be_ice(light_at(x, y)) ? 1 : 0;
  };
  for_each(parts, plate, [&](int x, int y) { judge(x, y, hue.has(light_at(x, y))); });
  for_each(parts, body, [&](int x, int y) { judge(x, y, is_granite(light_at(x, y), granite)); });

  cv::Mat asked;
  cv::min(parts, 1, asked);
  const int count = cv::countNonZero(asked);
  const int unlike = cv::countNonZero(off);
  if (count == 0 || unlike == 0) return seen;
  seen.area = area;
  seen.share = static_cast<double>(unlike) / count;
  seen.ice = static_cast<double>(ice) / unlike;
  seen.unlike = mostly(off, asked, std::max(1, area.width / widths_in_view));
  return seen;
}

}  // namespace hogline::vision
