#include "vision/fit/grip_evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "vision/fit/light_parts.hpp"
#include "vision/fit/sight_table.hpp"

namespace hogline::vision {
namespace {

constexpr double reach_m = 0.088;      // of a grip about the stone's axis
constexpr double beside_m = 0.105;     // of the axis: nothing of the grip is seen there any more
constexpr double neighbour_m = 1.5;    // farther stones are not seen through a grip
constexpr double least_range_m = 0.3;  // from under the camera
constexpr float hidden_px = -1.2F;     // so near to another stone nothing is believed
constexpr float edge_width_px = 4.0F;  // of plate and body against what is behind them
constexpr float most_granite = 0.25F;  // of a pixel: how light granite is there is not known
constexpr int tried_pixels = 300;      // of the rectangle about the grip
constexpr Eigen::Index fewest_plate = 16;
constexpr float either_noise2 = 0.01F;  // of the two colours that may be behind

struct Window {
  cv::Rect area;
  float left, right;  ///< columns beside the grip
};

struct Bounds {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9);
  Eigen::Vector2d high = Eigen::Vector2d::Constant(-1e9);
  void add(const Eigen::Vector2d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
};

std::optional<Window> window_of(const StonePicture& picture, const GripShape& shape, const Eigen::Vector2d& place) {
  const Bearing bearing = bearing_of(place, picture.eye());
  if (bearing.range_m < least_range_m) return std::nullopt;
  Bounds grip;
  Bounds beside;
  const double rim_m = picture.shape.handle_height_m;
  for (const double height_m : {rim_m, rim_m + shape.top_m}) {
    for (int i = 0; i < 8; ++i) {
      const double angle = 0.25 * std::numbers::pi * i;
      const auto inner = picture.camera.project(circle_point(place, bearing, reach_m, height_m, angle));
      const auto outer = picture.camera.project(circle_point(place, bearing, beside_m, height_m, angle));
      if (!inner || !outer || !picture.camera.lens().in_picture(*outer, 6.0)) return std::nullopt;
      grip.add(*inner);
      beside.add(*outer);
    }
  }
  const cv::Point a(static_cast<int>(std::floor(grip.low.x())) - 1, static_cast<int>(std::floor(grip.low.y())) - 1);
  const cv::Point b(static_cast<int>(std::ceil(grip.high.x())) + 2, static_cast<int>(std::ceil(grip.high.y())) + 2);
  return Window{{a, b}, static_cast<float>(beside.low.x()) - 2.0F, static_cast<float>(beside.high.x()) + 2.0F};
}

/// The stone, and the upright cylinder that its grip sweeps in any direction.
struct Outlines {
  StonePlace stone;
  StonePlace sweep;

  Outlines(const StonePicture& picture, const GripShape& shape, const Eigen::Vector2d& place)
      : stone{place, picture.shape}, sweep(stone) {
    sweep.shape.handle_radius_m = reach_m;
    sweep.shape.handle_height_m += shape.top_m;
    sweep.shape.handle_thickness_m = shape.top_m;
  }
};

/// Pixels of the window that a grip may cover.
struct Chosen {
  SightLines sights;
  std::array<int, most_pixels> x{}, y{};
  Eigen::Index count = 0;

  std::array<Pixels*, 6> lines() {
    return {&sights.x, &sights.y, &sights.x_by_column, &sights.x_by_row, &sights.y_by_column, &sights.y_by_row};
  }
  void cut_to(Eigen::Index length) {
    for (Pixels* p : lines()) p->conservativeResize(length);
    count = length;
  }
  void move(Eigen::Index from, Eigen::Index to) {
    for (Pixels* p : lines()) (*p)[to] = (*p)[from];
    x[static_cast<std::size_t>(to)] = x[static_cast<std::size_t>(from)];
    y[static_cast<std::size_t>(to)] = y[static_cast<std::size_t>(from)];
  }
};

// In a slanting pattern where they are many.
Chosen pixels_of(const StonePicture& picture, const cv::Rect& area) {
  Chosen all;
  const SightTable table(picture.camera, area);
  if (!table.ok()) return all;
  all.sights.resize(most_pixels);
  const int keep = area.area() / tried_pixels + 1;
  for (int y = area.y; y < area.br().y; ++y) {
    const SightTable::Row row = table.row(y);
    for (int x = area.x + (keep - (area.x + 3 * y) % keep) % keep; x < area.br().x; x += keep) {
      if (all.count == most_pixels) break;
      all.x[static_cast<std::size_t>(all.count)] = x;
      all.y[static_cast<std::size_t>(all.count)] = y;
      row.find(x, all.count++, all.sights);
    }
  }
  all.cut_to(all.count);
  return all;
}

void keep_within(const StonePlace& sweep, const Eigen::Vector3d& eye, Chosen& all) {
  Pixels inside;
  handle_px(sweep, eye, all.sights, inside);
  Eigen::Index kept = 0;
  for (Eigen::Index i = 0; i < all.count; ++i) {
    if (inside[i] > -1.0F) all.move(i, kept++);
  }
  all.cut_to(kept);
}

GripSights grip_sights(const SightLines& s, const Eigen::Vector3d& eye, const Eigen::Vector2d& place, double level_m) {
  const auto drop = static_cast<float>(eye.z() - level_m);
  GripSights g;
  g.x = static_cast<float>(eye.x() - place.x()) + drop * s.x;
  g.y = static_cast<float>(eye.y() - place.y()) + drop * s.y;
  g.by_pixel << drop * s.x_by_column.mean(), drop * s.x_by_row.mean(), drop * s.y_by_column.mean(),
      drop * s.y_by_row.mean();
  g.away = {s.x.mean(), s.y.mean()};
  return g;
}

/// 1 where no other stone is seen, nor its grip.
Pixels clear_of(const StonePicture& picture, const GripShape& shape, const Eigen::Vector2d& place,
                const std::vector<Eigen::Vector2d>& others, const SightLines& sights) {
  const Eigen::Vector3d eye = picture.eye();
  Pixels clear = Pixels::Ones(sights.x.size());
  Pixels plate;
  Pixels grip;
  Pixels body;
  for (const Eigen::Vector2d& other : others) {
    const double apart_m = (other - place).norm();
    if (apart_m > neighbour_m || apart_m < 0.5 * picture.shape.body_radius_m) continue;
    const Outlines its(picture, shape, other);
    handle_px(its.stone, eye, sights, plate);
    handle_px(its.sweep, eye, sights, grip);
    body_px(its.stone, eye, sights, body);
    clear *= (plate.max(grip).max(body) < hidden_px).cast<float>();
  }
  return clear;
}

Pixels share_inside(const Pixels& px) {
  const Pixels t = (0.5F + px / edge_width_px).max(0.0F).min(1.0F);
  return t * t * (3.0F - 2.0F * t);
}

/// Light as brightness and two colours, so that squares sum up by their weights.
Eigen::Vector3f weighed_parts(const Eigen::Array3f& bgr) {
  Eigen::Vector3f parts = parts_of(bgr.cast<double>().matrix()).cast<float>();
  parts.tail<2>() *= std::sqrt(colour_weight);
  return parts;
}

/// What is seen left and right of the grip, in the rows of its pixels.
class Surroundings {
 public:
  Surroundings(const PatchSource& source, const Window& window) : source_(source), window_(window) {}

  struct Behind {
    Eigen::Vector3f light;
    Eigen::Vector3f either;  ///< from the left one's to the right one's
  };
  std::optional<Behind> at(int x, int y) {
    if (y != row_) look(y);
    if (!known_) return std::nullopt;
    const float across = (static_cast<float>(x) - window_.left) / (window_.right - window_.left);
    return Behind{left_ + std::clamp(across, 0.0F, 1.0F) * either_, either_};
  }

 private:
  void look(int y) {
    Eigen::Array3f left;
    Eigen::Array3f right;
    row_ = y;
    const auto at = static_cast<float>(y);
    known_ = source_.mean_of_three(window_.left, at, -1.0F, 0.0F, left) &&
             source_.mean_of_three(window_.right, at, 1.0F, 0.0F, right);
    if (!known_) return;
    left_ = weighed_parts(left);
    either_ = weighed_parts(right) - left_;
  }

  const PatchSource& source_;
  Window window_;
  int row_ = -1;  ///< that was looked at last
  bool known_ = false;
  Eigen::Vector3f left_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f either_ = Eigen::Vector3f::Zero();
};

void weigh_pixel(Eigen::Index i, const Eigen::Vector3f& light, const Eigen::Vector3f& handle,
                 const Eigen::Vector3f& behind, const Eigen::Vector3f& either, GripEvidence& e) {
  const float doubt2 = either.squaredNorm() + either_noise2;
  const auto product = [&](const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
    return a.dot(b) - a.dot(either) * b.dot(either) / doubt2;
  };
  const Eigen::Vector3f seen = light - behind;
  e.weight[i] = 1.0F / (0.02F + 0.5F * std::max(0.0F, behind[0]));  // shot noise grows with the light
  e.seen_seen[i] = product(seen, seen);
  e.seen_handle[i] = product(seen, handle);
  e.seen_behind[i] = product(seen, behind);
  e.handle_handle[i] = product(handle, handle);
  e.handle_behind[i] = product(handle, behind);
  e.behind_behind[i] = product(behind, behind);
}

/// The middle one of the plate's pixels, of which a grip covers a few, says how light it is; its hue is known.
float plate_light(const PatchSource& source, const Chosen& chosen, const Pixels& on_plate, const Pixels& clear,
                  const Eigen::Vector3f& handle) {
  std::array<float, most_pixels> lights{};
  auto end = lights.begin();
  for (Eigen::Index i = 0; i < chosen.count; ++i) {
    if (clear[i] == 0.0F || on_plate[i] < 1.0F) continue;
    const auto k = static_cast<std::size_t>(i);
    *end++ = weighed_parts(source.at(chosen.x[k], chosen.y[k])).dot(handle) / std::max(1e-6F, handle.squaredNorm());
  }
  if (end - lights.begin() < fewest_plate) return 1.0F;
  const auto middle = lights.begin() + (end - lights.begin()) / 2;
  std::nth_element(lights.begin(), middle, end);
  return std::clamp(*middle, 0.6F, 1.5F);
}

}  // namespace

float GripEvidence::wall_light(const GripCover& cover, float expected, float sigma, float variance) const {
  const float prior = variance / (sigma * sigma);
  const Pixels all = cover.top + cover.side;
  const float right = (weight * cover.side * (seen_handle + all * handle_behind - cover.top * handle_handle)).sum();
  const float left = (weight * cover.side.square() * handle_handle).sum();
  return std::clamp((right + prior * expected) / (left + prior), 0.2F, 1.2F);
}

GripEvidence::Presence GripEvidence::presence(const GripCover& cover, float wall_light) const {
  const Pixels lit = cover.top + wall_light * cover.side;
  const Pixels all = cover.top + cover.side;
  const float seen = (weight * (lit * seen_handle - all * seen_behind)).sum();
  const float foretold =
      (weight * (lit * (lit * handle_handle - 2.0F * all * handle_behind) + all.square() * behind_behind)).sum();
  const float whole = std::max(1e-9F, foretold);
  return {seen / whole, 1.0F / std::sqrt(whole)};
}

double GripEvidence::lumpiness(const GripCover& cover, float wall_light) const {
  const Pixels all = misfits(cover, wall_light);
  std::array<float, most_pixels> sizes{};
  auto end = sizes.begin();
  for (Eigen::Index i = 0; i < all.size(); ++i) {
    if (weight[i] > 0.0F) *end++ = all[i];
  }
  if (end == sizes.begin()) return 0.0;
  const auto middle = sizes.begin() + (end - sizes.begin()) / 2;
  std::nth_element(sizes.begin(), middle, end);
  return double{all.sum()} / static_cast<double>(end - sizes.begin()) / std::max(1e-9, double{*middle});
}

Pixels GripEvidence::misfits(const GripCover& cover, float wall_light) const {
  const Pixels lit = cover.top + wall_light * cover.side;
  const Pixels all = cover.top + cover.side;
  return weight * (seen_seen + lit * (lit * handle_handle - 2.0F * seen_handle) +
                   all * (all * behind_behind + 2.0F * seen_behind) - 2.0F * lit * all * handle_behind);
}

GripEvidence grip_evidence(const StonePicture& picture, const GripShape& shape, const Eigen::Vector2d& place,
                           const Light& handle, const std::vector<Eigen::Vector2d>& others) {
  GripEvidence e;
  const auto window = window_of(picture, shape, place);
  if (!window) return e;
  const Eigen::Vector3d eye = picture.eye();
  const Outlines outlines(picture, shape, place);
  Chosen chosen = pixels_of(picture, window->area);
  keep_within(outlines.sweep, eye, chosen);
  if (chosen.count == 0) return e;

  e.sights = grip_sights(chosen.sights, eye, place, picture.shape.handle_height_m + shape.top_m);
  for (Pixels* p : {&e.weight, &e.seen_seen, &e.seen_handle, &e.seen_behind, &e.handle_handle, &e.handle_behind,
                    &e.behind_behind}) {
    p->setZero(chosen.count);
  }
  Pixels plate;
  Pixels body;
  handle_px(outlines.stone, eye, chosen.sights, plate);
  body_px(outlines.stone, eye, chosen.sights, body);
  const Pixels on_plate = share_inside(plate);
  const Pixels on_granite = (1.0F - on_plate) * share_inside(body);
  const Pixels clear = clear_of(picture, shape, place, others, chosen.sights);

  const PatchSource source(picture, place);
  Surroundings surroundings(source, *window);
  const Eigen::Vector3f hue = weighed_parts(handle.cast<float>().array());
  const Eigen::Vector3f plates = hue * plate_light(source, chosen, on_plate, clear, hue);
  for (Eigen::Index i = 0; i < chosen.count; ++i) {
    if (clear[i] == 0.0F || on_granite[i] > most_granite) continue;
    const int x = chosen.x[static_cast<std::size_t>(i)];
    const int y = chosen.y[static_cast<std::size_t>(i)];
    const Eigen::Vector3f light = weighed_parts(source.at(x, y));
    if (on_plate[i] >= 1.0F) {
      weigh_pixel(i, light, plates, plates, Eigen::Vector3f::Zero(), e);
    } else if (const auto beyond = surroundings.at(x, y)) {
      const Eigen::Vector3f behind = on_plate[i] * plates + (1.0F - on_plate[i]) * beyond->light;
      weigh_pixel(i, light, plates, behind, (1.0F - on_plate[i]) * beyond->either, e);
    }
  }
  e.used = static_cast<double>((e.weight > 0.0F).count());
  e.visible = e.used / static_cast<double>(chosen.count);
  return e;
}

}  // namespace hogline::vision
