#include "vision/detect/handle_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace hogline::vision {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double side_m = 0.32;  // beside a known stone
constexpr double from_m = 0.08;  // behind it
constexpr double to_m = 0.70;
constexpr int margin_px = 40;
constexpr double beside = 1.35;         // handle's radii: no plate any more
constexpr double grip_height_m = 0.06;  // over the plate
constexpr double grip_radius_m = 0.085;
constexpr float least_likeness = 0.40F;
constexpr float least_seen = 0.30F;  // share of the plate
constexpr float far_m = 1e6F;

/// What is left of a colour without its brightness: red and blue against brightness.
Eigen::Vector2f chroma(const Eigen::Vector3f& bgr) {
  const float light = 0.114F * bgr[0] + 0.587F * bgr[1] + 0.299F * bgr[2];
  return {bgr[2] - light, bgr[0] - light};
}

float alike(const Eigen::Vector2f& seen, const Eigen::Vector2f& wanted) {
  const float square = wanted.squaredNorm();
  const float part = std::clamp(seen.dot(wanted) / square, 0.0F, 1.0F);
  const float off = (seen - part * wanted).norm() / (0.5F * std::sqrt(square));
  return part * std::max(0.0F, 1.0F - off * off);
}

Eigen::Vector3f light_at(const StonePicture& picture, int x, int y, const std::array<float, 3>& white) {
  const std::uint8_t* p = picture.bgr.ptr<std::uint8_t>(y) + 3 * x;
  return {picture.response.linear(p[0]) / white[0], picture.response.linear(p[1]) / white[1],
          picture.response.linear(p[2]) / white[2]};
}

}  // namespace

HandleSearch::Template HandleSearch::draw(const StonePicture& picture, const Eigen::Vector2d& place) const {
  Template t;
  const StoneShape& shape = picture.shape;
  const Bearing bearing = bearing_of(place, picture.eye());
  const auto centre = picture.camera.project({place.x(), place.y(), shape.handle_height_m});
  if (!centre) return t;
  const auto add = [&](std::vector<cv::Point2f>& points, double radius, double angle, double height_m) {
    const auto p =
        picture.camera.project(circle_point(place, bearing, radius * shape.handle_radius_m, height_m, angle));
    if (!p) return;
    points.emplace_back(static_cast<float>(p->x() - centre->x()), static_cast<float>(p->y() - centre->y()));
  };
  for (const double radius : {0.3, 0.6, 0.88}) {
    const int count = static_cast<int>(std::lround(16 * radius));
    for (int i = 0; i < count; ++i) add(t.plate, radius, 2.0 * pi * (i + 0.5) / count, shape.handle_height_m);
  }
  const double wall_m = shape.handle_height_m - 0.6 * shape.handle_thickness_m;
  for (int i = 0; i < 7; ++i) add(t.plate, 0.97, -pi * (i + 0.5) / 7.0, wall_m);
  const double shoulder_m = shape.handle_height_m - 1.5 * shape.handle_thickness_m;
  for (int i = 0; i < 9; ++i) add(t.beside, beside, -pi * (i + 0.5) / 9.0, shoulder_m);
  for (const double angle : {0.02, 0.12, 0.22, 0.78, 0.88, 0.98}) {
    add(t.beside, beside, pi * angle, shape.handle_height_m);
  }
  return t;
}

// The nearest stone at each pixel, and how far away it is.
void HandleSearch::cover(const StonePicture& picture, const std::vector<KnownStone>& known, const cv::Rect& area) {
  range_.create(area.size(), CV_32F);
  range_.setTo(far_m);
  const Eigen::Vector3d eye = picture.eye();
  std::vector<KnownStone> nearest_last = known;
  std::sort(nearest_last.begin(), nearest_last.end(), [&eye](const KnownStone& a, const KnownStone& b) {
    return (a.place - eye.head<2>()).norm() > (b.place - eye.head<2>()).norm();
  });
  constexpr int shift = 4;
  for (const KnownStone& s : nearest_last) {
    const Bearing bearing = bearing_of(s.place, eye);
    std::vector<cv::Point> body;
    std::vector<cv::Point> plate;
    bool ok = true;
    const auto add = [&](std::vector<cv::Point>& outline, const Eigen::Vector3d& point) {
      const auto p = picture.camera.project(point);
      ok = ok && p;
      if (!p) return;
      outline.emplace_back(static_cast<int>(std::lround((p->x() - area.x) * (1 << shift))),
                           static_cast<int>(std::lround((p->y() - area.y) * (1 << shift))));
    };
    for (int i = 0; i < 20; ++i) {
      const double angle = 2.0 * pi * i / 20.0;
      add(body, body_outline_point(s.place, picture.shape, eye, angle));
      add(plate, circle_point(s.place, bearing, picture.shape.handle_radius_m, picture.shape.handle_height_m, angle));
    }
    if (!ok) continue;
    const cv::Scalar range(bearing.range_m);
    cv::fillConvexPoly(range_, body, range, cv::LINE_8, shift);
    cv::fillConvexPoly(range_, plate, range, cv::LINE_8, shift);
  }
}

void HandleSearch::paint_likeness(const StonePicture& picture, const Eigen::Vector3d& colour, const cv::Rect& area) {
  likeness_.create(area.size(), CV_32F);
  const Eigen::Vector2f wanted = chroma(colour.cast<float>());
  const auto white = picture.ice.at(area.x + 0.5 * area.width, area.y + 0.5 * area.height);
  for (int y = 0; y < area.height; ++y) {
    auto* out = likeness_.ptr<float>(y);
    for (int x = 0; x < area.width; ++x) {
      out[x] = alike(chroma(light_at(picture, area.x + x, area.y + y, white)), wanted);
    }
  }
}

float HandleSearch::likeness(const Template& handle, float x, float y, float range_m) const {
  const auto mean = [&](const std::vector<cv::Point2f>& points, float& seen) {
    float sum = 0.0F;
    int count = 0;
    for (const cv::Point2f& p : points) {
      const int column = static_cast<int>(x + p.x + 0.5F);
      const int row = static_cast<int>(y + p.y + 0.5F);
      if (column < 0 || row < 0 || column >= likeness_.cols || row >= likeness_.rows) continue;
      const float like = likeness_.at<float>(row, column);
      if (range_.at<float>(row, column) < range_m - 0.1F || like < 0.0F) continue;
      sum += like;
      ++count;
    }
    seen = static_cast<float>(count) / static_cast<float>(points.size());
    return count > 0 ? sum / static_cast<float>(count) : 0.0F;
  };
  float seen = 0.0F;
  float beside_seen = 0.0F;
  const float on_plate = mean(handle.plate, seen);
  if (seen < least_seen) return 0.0F;
  return on_plate - mean(handle.beside, beside_seen);
}

void HandleSearch::search(const StonePicture& picture, const KnownStone& nearer, const std::vector<KnownStone>& known) {
  const Eigen::Vector3d eye = picture.eye();
  const Bearing bearing = bearing_of(nearer.place, eye);
  const Template handle = draw(picture, nearer.place + 0.35 * bearing.away);
  if (handle.plate.empty()) return;
  cv::Rect window;
  for (const double side : {-side_m, side_m}) {
    for (const double away : {from_m, to_m}) {
      const Eigen::Vector2d p = nearer.place + side * bearing.right + away * bearing.away;
      const auto pixel = picture.camera.project({p.x(), p.y(), picture.shape.handle_height_m});
      if (!pixel) continue;
      const cv::Rect here(static_cast<int>(pixel->x()), static_cast<int>(pixel->y()), 1, 1);
      window = window.empty() ? here : window | here;
    }
  }
  const cv::Rect area = cv::Rect(window.x - margin_px, window.y - margin_px, window.width + 2 * margin_px,
                                 window.height + 2 * margin_px) &
                        cv::Rect(0, 0, picture.bgr.cols, picture.bgr.rows);
  window &= area;
  if (window.empty()) return;
  cover(picture, known, area);
  std::vector<KnownStone> colours;
  for (const KnownStone& s : known) {
    const bool new_one = std::none_of(colours.begin(), colours.end(), [&s](const KnownStone& c) {
      return alike(chroma(s.handle.cast<float>()), chroma(c.handle.cast<float>())) > 0.6F;
    });
    if (new_one) colours.push_back(s);
  }
  for (const KnownStone& colour : colours) {
    paint_likeness(picture, colour.handle, area);
    for (int y = window.y; y < window.br().y; ++y) {
      for (int x = window.x; x < window.br().x; ++x) {
        const auto place =
            picture.camera.plane_at({static_cast<double>(x), static_cast<double>(y)}, picture.shape.handle_height_m);
        if (!place) continue;
        const auto range_m = static_cast<float>((*place - eye.head<2>()).norm());
        const float like = likeness(handle, static_cast<float>(x - area.x), static_cast<float>(y - area.y), range_m);
        if (like < least_likeness) continue;
        peaks_.push_back({static_cast<float>(x), static_cast<float>(y), like});
      }
    }
  }
}

const std::vector<StoneCandidate>& HandleSearch::find(const StonePicture& picture,
                                                      const std::vector<KnownStone>& known) {
  peaks_.clear();
  candidates_.clear();
  for (const KnownStone& s : known) search(picture, s, known);
  std::sort(peaks_.begin(), peaks_.end(), [](const Peak& a, const Peak& b) {
    return a.likeness != b.likeness ? a.likeness > b.likeness : a.y != b.y ? a.y < b.y : a.x < b.x;
  });
  for (const Peak& p : peaks_) {
    const Eigen::Vector2d pixel(p.x, p.y);
    const auto place = picture.camera.plane_at(pixel, picture.shape.handle_height_m);
    if (!place) continue;
    const bool near_another =
        std::any_of(candidates_.begin(), candidates_.end(),
                    [&](const StoneCandidate& c) { return (c.place - *place).norm() < 0.14 && false; }) ||
        std::any_of(candidates_.begin(), candidates_.end(), [&](const StoneCandidate& c) {
          const Bearing b = bearing_of(c.place, picture.eye());
          const Eigen::Vector2d off = *place - c.place;
          return std::abs(off.dot(b.right)) < 0.10 && std::abs(off.dot(b.away)) < 0.20;
        });
    if (near_another) continue;
    candidates_.push_back({*place, pixel, double{p.likeness}, double{p.likeness}, 0.0});
  }
  return candidates_;
}

}  // namespace hogline::vision
