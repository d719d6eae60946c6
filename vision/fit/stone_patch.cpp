#include "vision/fit/stone_patch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hogline::vision {
namespace {

constexpr double margin_px = 3.0;
constexpr double band_px = 3.5;     // about an outline: blur, and what the fit may move
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
  const cv::Point a(static_cast<int>(std::floor(low.x() - margin_px)), static_cast<int>(std::floor(low.y() - margin_px)));
  const cv::Point b(static_cast<int>(std::ceil(high.x() + margin_px)), static_cast<int>(std::ceil(high.y() + margin_px)));
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
  std::vector<StonePixel> all;
  for (int y = area.y; y < area.br().y; ++y) {
    const std::uint8_t* row = source.bgr.ptr<std::uint8_t>(y);
    for (int x = area.x; x < area.br().x; ++x) {
      // Of a big stone every second pixel in a chequered pattern, of a bigger one every fourth.
      const int keep = static_cast<std::size_t>(area.area()) > 8 * most ? 4 : static_cast<std::size_t>(area.area()) > 3 * most ? 2 : 1;
      if ((x + 2 * y + y / 2) % keep != 0) continue;
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

void look_behind(const PatchSource& source, const StonePlace& stone, const Eigen::Vector3d& eye,
                 const Light& handle_colour, std::vector<StonePixel>& pixels) {
  for (StonePixel& p : pixels) {
    const RegionDistance handle = handle_distance(stone, eye, p.sight);
    const RegionDistance body = body_distance(stone, eye, p.sight);
    const RegionDistance& outer = handle.px > body.px ? handle : body;
    p.usable = true;
    p.behind.setZero();
    if (outer.px > band_px + 0.5) continue;  // nothing behind shines through
    int samples = 0;
    for (int i = 0; i < 3; ++i) {
      Light light;
      if (!source.light_at(p.pixel + (std::max(outer.px, -clearance_px) + clearance_px + i) * outer.outward, light)) {
        continue;
      }
      p.behind += light;
      ++samples;
    }
    if (samples == 0) {
      p.usable = false;
      continue;
    }
    p.behind /= samples;
    // The grip stands over the handle's far side: no outline is to be seen there.
    const bool grip = &outer == &handle && (p.behind - handle_colour).norm() < 0.35 * (Light::Ones() - handle_colour).norm();
    if (grip) p.usable = false;
  }
}

}  // namespace hogline::vision
