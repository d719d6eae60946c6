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
constexpr double most_seen_m = 0.10;   // of a touching stone's body over a nearer one: more would have been found
constexpr double other_side_m = 0.10;  // two peaks nearer than this are of one stone
constexpr double other_away_m = 0.20;
constexpr float least_chroma = 0.08F;
constexpr int shift = 4;         // of outlines' coordinates
constexpr double beside = 1.35;  // handle's radii: no plate any more
constexpr float least_likeness = 0.40F;
constexpr float least_seen = 0.30F;  // share of the plate
constexpr float far_m = 1e6F;

/// What is left of a colour without its brightness: red and blue against brightness.
Eigen::Vector2f chroma(const Eigen::Vector3f& bgr) {
  const float light = 0.114F * bgr[0] + 0.587F * bgr[1] + 0.299F * bgr[2];
  return {bgr[2] - light, bgr[0] - light};
}

/// How much of one colour is in another, whatever grey is mixed with it.
class Likeness {
 public:
  explicit Likeness(const Eigen::Vector3f& bgr)
      : wanted_(chroma(bgr)), per_square_(1.0F / std::max(1e-6F, wanted_.squaredNorm())) {}

  float of(const Eigen::Vector2f& seen) const {
    const float part = std::clamp(seen.dot(wanted_) * per_square_, 0.0F, 1.0F);
    const float off = 4.0F * (seen - part * wanted_).squaredNorm() * per_square_;
    return part * std::max(0.0F, 1.0F - off);
  }

 private:
  Eigen::Vector2f wanted_;
  float per_square_;
};

}  // namespace

HandleSearch::Template HandleSearch::draw(const StonePicture& picture, const Eigen::Vector2d& place) const {
  Template t;
  const StoneShape& shape = picture.shape;
  const Bearing bearing = bearing_of(place, picture.eye());
  const auto centre = picture.camera.project({place.x(), place.y(), shape.handle_height_m});
  if (!centre) return t;
  const auto add = [&](std::vector<cv::Point>& points, double radius, double angle, double height_m) {
    const auto p =
        picture.camera.project(circle_point(place, bearing, radius * shape.handle_radius_m, height_m, angle));
    if (!p) return;
    points.emplace_back(static_cast<int>(std::lround(p->x() - centre->x())),
                        static_cast<int>(std::lround(p->y() - centre->y())));
    t.reach_px = std::max({t.reach_px, std::abs(points.back().x), std::abs(points.back().y)});
  };
  for (const double radius : {0.3, 0.6, 0.88}) {
    const int count = static_cast<int>(std::lround(16 * radius));
    for (int i = 0; i < count; ++i) add(t.plate, radius, 2.0 * pi * (i + 0.5) / count, shape.handle_height_m);
  }
  const double wall_m = shape.handle_height_m - 0.6 * shape.handle_thickness_m;
  for (int i = 0; i < 7; ++i) add(t.plate, 0.97, -pi * (i + 0.5) / 7.0, wall_m);
  for (std::size_t i = 0; i < t.plate.size(); i += 5) t.few.push_back(t.plate[i]);
  const double shoulder_m = shape.handle_height_m - 1.5 * shape.handle_thickness_m;
  for (int i = 0; i < 9; ++i) add(t.beside, beside, -pi * (i + 0.5) / 9.0, shoulder_m);
  // Above the middle its own grip is seen.
  for (const double angle : {0.02, 0.12, 0.22, 0.78, 0.88, 0.98}) {
    add(t.beside, beside, pi * angle, shape.handle_height_m);
  }
  t.step_px = t.reach_px > 14 ? 2 : 1;
  return t;
}

// The nearest stone at each pixel, and how far away it is.
void HandleSearch::cover(const StonePicture& picture, const std::vector<KnownStone>& known) {
  range_.create(area_.size(), CV_32F);
  range_.setTo(far_m);
  for (const KnownStone& s : known) {
    if (!draw_outlines(picture, s.place)) continue;
    const cv::Scalar range((s.place - picture.eye().head<2>()).norm());
    cv::fillConvexPoly(range_, body_, range, cv::LINE_8, shift);
    cv::fillConvexPoly(range_, plate_, range, cv::LINE_8, shift);
  }
}

// Outlines in sixteenths of the area's pixels.
bool HandleSearch::draw_outlines(const StonePicture& picture, const Eigen::Vector2d& place) {
  const Eigen::Vector3d eye = picture.eye();
  const StoneShape& shape = picture.shape;
  const Bearing bearing = bearing_of(place, eye);
  body_.clear();
  plate_.clear();
  const auto add = [&](std::vector<cv::Point>& outline, const Eigen::Vector3d& point) {
    const auto p = picture.camera.project(point);
    if (!p) return false;
    outline.emplace_back(static_cast<int>(std::lround((p->x() - area_.x) * (1 << shift))),
                         static_cast<int>(std::lround((p->y() - area_.y) * (1 << shift))));
    return true;
  };
  constexpr int points = 16;
  for (int i = 0; i < points; ++i) {
    const double angle = 2.0 * pi * i / points;
    if (!add(body_, body_outline_point(place, shape, eye, angle))) return false;
    if (!add(plate_, circle_point(place, bearing, shape.handle_radius_m, shape.handle_height_m, angle))) return false;
  }
  return true;
}

void HandleSearch::paint_likeness(const StonePicture& picture, const Eigen::Vector3d& colour) {
  likeness_.create(area_.size(), CV_32F);
  const Likeness like(colour.cast<float>());
  const auto white = picture.ice.at(area_.x + 0.5 * area_.width, area_.y + 0.5 * area_.height);
  std::array<std::array<float, 256>, 3> light;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t v = 0; v < 256; ++v) {
      light[k][v] = picture.response.linear(static_cast<std::uint8_t>(v)) / white[k];
    }
  }
  for (int y = 0; y < area_.height; ++y) {
    const std::uint8_t* in = picture.bgr.ptr<std::uint8_t>(area_.y + y) + 3 * area_.x;
    auto* out = likeness_.ptr<float>(y);
    for (int x = 0; x < area_.width; ++x, in += 3) {
      out[x] = like.of(chroma({light[0][in[0]], light[1][in[1]], light[2][in[2]]}));
    }
  }
}

float HandleSearch::mean(const std::vector<cv::Point>& points, int x, int y, float range_m, int& seen) const {
  float sum = 0.0F;
  seen = 0;
  for (const cv::Point& p : points) {
    const int column = x + p.x;
    const int row = y + p.y;
    if (column < 0 || row < 0 || column >= likeness_.cols || row >= likeness_.rows) continue;
    if (range_.at<float>(row, column) < range_m) continue;
    sum += likeness_.at<float>(row, column);
    ++seen;
  }
  return seen > 0 ? sum / static_cast<float>(seen) : 0.0F;
}

// How much more a plate's place has of the colour than what is beside it.
float HandleSearch::likeness(const Template& handle, int x, int y, float range_m) const {
  int seen = 0;
  if (mean(handle.few, x, y, range_m, seen) < least_likeness && seen > 0) return 0.0F;
  const float on_plate = mean(handle.plate, x, y, range_m, seen);
  if (on_plate < least_likeness || static_cast<float>(seen) < least_seen * static_cast<float>(handle.plate.size())) {
    return 0.0F;
  }
  return on_plate - mean(handle.beside, x, y, range_m, seen);
}

// Where a plate may be seen over a known stone that hides what stands behind it.
cv::Rect HandleSearch::window_behind(const StonePicture& picture, const Eigen::Vector2d& nearer) {
  const Eigen::Vector3d eye = picture.eye();
  const Bearing bearing = bearing_of(nearer, eye);
  const double descent = (eye.z() - picture.shape.handle_height_m) / bearing.range_m;
  if (descent * 2.0 * picture.shape.body_radius_m > most_seen_m) return {};
  cv::Rect window;
  for (const double side : {-side_m, side_m}) {
    for (const double away : {from_m, to_m}) {
      const Eigen::Vector2d p = nearer + side * bearing.right + away * bearing.away;
      const auto pixel = picture.camera.project({p.x(), p.y(), picture.shape.handle_height_m});
      if (!pixel) continue;
      const cv::Rect here(static_cast<int>(pixel->x()), static_cast<int>(pixel->y()), 1, 1);
      window = window.empty() ? here : window | here;
    }
  }
  handle_ = draw(picture, nearer + 0.5 * (from_m + to_m) * bearing.away);
  return window & cv::Rect(0, 0, picture.bgr.cols, picture.bgr.rows);
}

void HandleSearch::search(const StonePicture& picture, const cv::Rect& window, const std::vector<KnownStone>& known) {
  const int margin = handle_.reach_px + 1;
  area_ = cv::Rect(window.x - margin, window.y - margin, window.width + 2 * margin, window.height + 2 * margin) &
          cv::Rect(0, 0, picture.bgr.cols, picture.bgr.rows);
  cover(picture, known);
  const Eigen::Vector2d eye = picture.eye().head<2>();
  for (const Eigen::Vector3d& colour : colours_) {
    paint_likeness(picture, colour);
    for (int y = window.y; y < window.br().y; ++y) {
      const double middle = window.x + 0.5 * window.width;
      const auto place = picture.camera.plane_at({middle, static_cast<double>(y)}, picture.shape.handle_height_m);
      if (!place) continue;
      const auto range_m = static_cast<float>((*place - eye).norm()) - 0.1F;
      for (int x = window.x; x < window.br().x; x += handle_.step_px) {
        const float like = likeness(handle_, x - area_.x, y - area_.y, range_m);
        if (like >= least_likeness) peaks_.push_back({x, y, like});
      }
    }
  }
}

// One of each kind.
void HandleSearch::choose_colours(const std::vector<KnownStone>& known) {
  colours_.clear();
  for (const KnownStone& s : known) {
    const Eigen::Vector2f seen = chroma(s.handle.cast<float>());
    const bool is_new =
        seen.norm() > least_chroma && std::none_of(colours_.begin(), colours_.end(), [&seen](const Eigen::Vector3d& c) {
          return Likeness(c.cast<float>()).of(seen) > 0.6F;
        });
    if (is_new) colours_.push_back(s.handle);
  }
}

const std::vector<StoneCandidate>& HandleSearch::find(const StonePicture& picture, const std::vector<KnownStone>& known,
                                                      const std::vector<KnownStone>& nearer) {
  peaks_.clear();
  candidates_.clear();
  choose_colours(known);
  const Eigen::Vector2d eye = picture.eye().head<2>();
  std::vector<KnownStone> nearest_last = known;
  std::sort(nearest_last.begin(), nearest_last.end(), [&eye](const KnownStone& a, const KnownStone& b) {
    return (a.place - eye).squaredNorm() > (b.place - eye).squaredNorm();
  });
  for (const KnownStone& s : nearer) {
    const cv::Rect window = window_behind(picture, s.place);
    if (!window.empty() && !handle_.plate.empty()) search(picture, window, nearest_last);
  }
  std::sort(peaks_.begin(), peaks_.end(), [](const Peak& a, const Peak& b) {
    return a.likeness != b.likeness ? a.likeness > b.likeness : a.y != b.y ? a.y < b.y : a.x < b.x;
  });
  for (const Peak& p : peaks_) {
    const Eigen::Vector2d pixel(p.x, p.y);
    const auto place = picture.camera.plane_at(pixel, picture.shape.handle_height_m);
    if (!place) continue;
    const bool near_another = std::any_of(candidates_.begin(), candidates_.end(), [&](const StoneCandidate& c) {
      const Bearing b = bearing_of(c.place, picture.eye());
      const Eigen::Vector2d off = *place - c.place;
      return std::abs(off.dot(b.right)) < other_side_m && std::abs(off.dot(b.away)) < other_away_m;
    });
    if (near_another) continue;
    candidates_.push_back({*place, pixel, double{p.likeness}, double{p.likeness}, 0.0});
  }
  return candidates_;
}

}  // namespace hogline::vision
