#include "vision/fit/stone_patch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hogline::vision {
namespace {

constexpr double margin_px = 3.0;
constexpr double band_px = 3.5;       // about an outline: blur, and what the fit may move
constexpr double clearance_px = 2.8;  // beyond the outline the stone's light has faded

/// Lines of sight of a rectangle, by second-order interpolation between nine.
class SightTable {
 public:
  SightTable(const SheetCamera& camera, const cv::Rect& area) : area_(area) {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) {
        const Eigen::Vector2d pixel(area.x + 0.5 * i * (area.width - 1), area.y + 0.5 * j * (area.height - 1));
        const auto ray = camera.lens().ray(pixel);
        if (!ray) {
          ok_ = false;
          return;
        }
        const Eigen::Vector3d d = camera.eMc().linear() * *ray;
        if (!(d.z() < -1e-3)) {
          ok_ = false;
          return;
        }
        knots_[static_cast<std::size_t>(3 * j + i)] = d.head<2>() / -d.z();
      }
    }
  }

  bool ok() const { return ok_; }

  SightLine at(const Eigen::Vector2d& pixel) const {
    const double u = (pixel.x() - area_.x) / (0.5 * (area_.width - 1));
    const double v = (pixel.y() - area_.y) / (0.5 * (area_.height - 1));
    const auto weights = [](double t) -> Eigen::Vector3d {
      return {0.5 * (t - 1.0) * (t - 2.0), t * (2.0 - t), 0.5 * t * (t - 1.0)};
    };
    const auto slopes = [](double t) -> Eigen::Vector3d { return {t - 1.5, 2.0 - 2.0 * t, t - 0.5}; };
    const Eigen::Vector3d wu = weights(u);
    const Eigen::Vector3d wv = weights(v);
    const Eigen::Vector3d su = slopes(u) / (0.5 * (area_.width - 1));
    const Eigen::Vector3d sv = slopes(v) / (0.5 * (area_.height - 1));
    SightLine sight{Eigen::Vector2d::Zero(), Eigen::Matrix2d::Zero()};
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) {
        const Eigen::Vector2d& knot = knots_[static_cast<std::size_t>(3 * j + i)];
        sight.slope += wu[i] * wv[j] * knot;
        sight.by_pixel.col(0) += su[i] * wv[j] * knot;
        sight.by_pixel.col(1) += wu[i] * sv[j] * knot;
      }
    }
    return sight;
  }

 private:
  cv::Rect area_;
  bool ok_ = true;
  std::array<Eigen::Vector2d, 9> knots_;
};

cv::Rect bounds_of(const SheetCamera& camera, const StonePlace& stone) {
  const Eigen::Vector3d eye = camera.eMc().translation();
  const Bearing bearing = bearing_of(stone.place, eye);
  if (bearing.range_m < 2.0 * stone.shape.body_radius_m) return {};
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9);
  Eigen::Vector2d high = Eigen::Vector2d::Constant(-1e9);
  for (int i = 0; i < 16; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 16.0;
    for (const Eigen::Vector3d& p :
         {body_outline_point(stone.place, stone.shape, eye, angle),
          circle_point(stone.place, bearing, stone.shape.handle_radius_m, stone.shape.handle_height_m, angle)}) {
      const auto pixel = camera.project(p);
      if (!pixel) return {};
      low = low.cwiseMin(*pixel);
      high = high.cwiseMax(*pixel);
    }
  }
  const cv::Point a(static_cast<int>(std::floor(low.x() - margin_px)),
                    static_cast<int>(std::floor(low.y() - margin_px)));
  const cv::Point b(static_cast<int>(std::ceil(high.x() + margin_px)),
                    static_cast<int>(std::ceil(high.y() + margin_px)));
  const Intrinsics& k = camera.lens().intrinsics();
  return cv::Rect(a, b) & cv::Rect(0, 0, k.width_px, k.height_px);
}

}  // namespace

bool PatchSource::light_at(const Eigen::Vector2d& pixel, Light& light) const {
  if (!(pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() < bgr.cols - 1 && pixel.y() < bgr.rows - 1)) return false;
  const int x = static_cast<int>(pixel.x());
  const int y = static_cast<int>(pixel.y());
  const double u = pixel.x() - x;
  const double v = pixel.y() - y;
  const std::uint8_t* top = bgr.ptr<std::uint8_t>(y) + 3 * x;
  const std::uint8_t* low = bgr.ptr<std::uint8_t>(y + 1) + 3 * x;
  for (int k = 0; k < 3; ++k) {
    const double a = double{response.linear(top[k])} * (1.0 - u) + double{response.linear(top[k + 3])} * u;
    const double b = double{response.linear(low[k])} * (1.0 - u) + double{response.linear(low[k + 3])} * u;
    light[k] = (a + v * (b - a)) / white[k];
  }
  return true;
}

std::vector<StonePixel> stone_pixels(const PatchSource& source, const SheetCamera& camera, const StonePlace& stone,
                                     std::size_t most) {
  const cv::Rect area = bounds_of(camera, stone);
  if (area.width < 6 || area.height < 6) return {};
  const SightTable sights(camera, area);
  if (!sights.ok()) return {};
  const Eigen::Vector3d eye = camera.eMc().translation();
  // About a third of the rectangle lies near an outline; of a big stone, every few pixels in a slanting pattern do.
  const int keep = std::clamp(area.area() / static_cast<int>(3 * most), 1, 10);
  std::vector<StonePixel> all;
  for (int y = area.y; y < area.br().y; ++y) {
    const std::uint8_t* row = source.bgr.ptr<std::uint8_t>(y);
    for (int x = area.x; x < area.br().x; ++x) {
      if ((x + 3 * y) % keep != 0) continue;
      StonePixel p;
      p.pixel = {x, y};
      p.sight = sights.at(p.pixel);
      const double handle = handle_distance(stone, eye, p.sight).px;
      const double body = body_distance(stone, eye, p.sight).px;
      if (std::abs(handle) > band_px && std::abs(body) > band_px) continue;
      if (std::max(handle, body) < -band_px) continue;
      for (int k = 0; k < 3; ++k) p.light[k] = double{source.response.linear(row[3 * x + k])} / source.white[k];
      all.push_back(p);
    }
  }
  return all;
}

namespace {

/// The mean of three samples a pixel apart; false where the picture ends.
bool mean_light(const PatchSource& source, const Eigen::Vector2d& from, const Eigen::Vector2d& step, Light& mean) {
  mean.setZero();
  for (int i = 0; i < 3; ++i) {
    Light light;
    if (!source.light_at(from + i * step, light)) return false;
    mean += light / 3.0;
  }
  return true;
}

/// What is to the left and right of a stone, row by row.
class Sides {
 public:
  Sides(const PatchSource& source, const std::vector<StonePixel>& pixels) : source_(source) {
    for (const StonePixel& p : pixels) {
      left_ = std::min(left_, p.pixel.x());
      right_ = std::max(right_, p.pixel.x());
    }
  }

  /// Between the two sides where they agree; nothing where they do not.
  bool at(const Eigen::Vector2d& pixel, Light& light) const {
    Light left;
    Light right;
    if (!mean_light(source_, {left_, pixel.y()}, {-1.0, 0.0}, left)) return false;
    if (!mean_light(source_, {right_, pixel.y()}, {1.0, 0.0}, right)) return false;
    if ((left - right).norm() > 0.15 + 0.15 * (left + right).norm()) return false;
    const double part = (pixel.x() - left_) / std::max(1.0, right_ - left_);
    light = left + part * (right - left);
    return true;
  }

 private:
  const PatchSource& source_;
  double left_ = 1e9;
  double right_ = -1e9;
};

/// There is something of the handle's colour over the rim: its grip.
bool grip_over(const PatchSource& source, const Eigen::Vector2d& rim, const Eigen::Vector2d& outward, double reach_px,
               const Light& handle, const Light& behind) {
  const Light change = handle - behind;
  const double size = change.norm();
  if (size < 0.1) return true;  // it could not be told
  for (double px = 1.2; px < reach_px; px += 1.0) {
    Light light;
    if (!source.light_at(rim + px * outward, light)) return true;
    const Light difference = light - behind;
    const double part = difference.dot(change) / (size * size);
    const double other = (difference - part * change).norm();
    const double fading = px < 2.0 ? 0.2 : 0.0;  // of the rim itself
    if (part > 0.25 + fading && other < 0.6 * part * size) return true;
  }
  return false;
}

}  // namespace

void look_behind(const PatchSource& source, const StonePlace& stone, const Eigen::Vector3d& eye,
                 const Light& handle_colour, std::vector<StonePixel>& pixels) {
  const Sides sides(source, pixels);
  const double grip_m = 0.06;
  for (StonePixel& p : pixels) {
    const RegionDistance handle = handle_distance(stone, eye, p.sight);
    const RegionDistance body = body_distance(stone, eye, p.sight);
    const RegionDistance& outer = handle.px > body.px ? handle : body;
    p.usable = true;
    p.behind.setZero();
    if (outer.px > band_px + 0.5) continue;  // nothing behind shines through
    const Eigen::Vector2d rim = p.pixel + outer.px * outer.outward;
    const bool far_rim = &outer == &handle;
    const bool known = far_rim && sides.at(rim + clearance_px * outer.outward, p.behind);
    if (!known && !mean_light(source, rim + clearance_px * outer.outward, outer.outward, p.behind)) {
      p.usable = false;
      continue;
    }
    if (far_rim && handle_colour.squaredNorm() > 0.0) {
      const double px_per_m = 1.0 / std::max(1e-9, (eye.z() * p.sight.by_pixel.col(0)).norm());
      const double reach_px = std::clamp(grip_m * px_per_m, 2.5, 12.0);
      p.usable = !grip_over(source, rim, outer.outward, reach_px, handle_colour, p.behind);
    }
  }
}

}  // namespace hogline::vision
