#include "hw/sim/solids_painter.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hogline::hw::sim {
namespace {

constexpr int tile_w = RayTable::tile_width;
constexpr int tile_h = RayTable::tile_height;
constexpr int samples_across = tile_w + 1;

struct Sample {
  float red = 0.0F;
  float green = 0.0F;
  float blue = 0.0F;
  float solid = 0.0F;
};
using Samples = std::array<Sample, samples_across*(tile_h + 1)>;

Ray turned(const IceView& view, const Eigen::Vector3f& c) {
  const auto& r = view.eRc;
  return {{view.x_m, view.y_m, view.height_m},
          {r[0] * c.x() + r[1] * c.y() + r[2] * c.z(), r[3] * c.x() + r[4] * c.y() + r[5] * c.z(),
           r[6] * c.x() + r[7] * c.y() + r[8] * c.z()}};
}

float mean(const float* top, const float* bottom) { return 0.25F * (top[0] + top[1] + bottom[0] + bottom[1]); }

float part(const Colour& c, int plane) { return plane == 0 ? c.red : plane == 1 ? c.green : c.blue; }

std::optional<Hit> nearest_hit(const Ray& ray, const std::vector<const Solid*>& solids) {
  std::optional<Hit> nearest;
  for (const Solid* solid : solids) {
    const auto hit = solid->meet(ray);
    if (hit && (!nearest || hit->distance < nearest->distance)) nearest = hit;
  }
  return nearest;
}

void lay_over(const Samples& samples, int i, Strip& strip) {
  for (int y = 0; y < tile_h; ++y) {
    float* red = strip.row(0, y) + i * tile_w;
    float* green = strip.row(1, y) + i * tile_w;
    float* blue = strip.row(2, y) + i * tile_w;
    for (int x = 0; x < tile_w; ++x) {
      const Sample* top = &samples[static_cast<std::size_t>(y * samples_across + x)];
      const Sample* bottom = top + samples_across;
      const auto of = [top, bottom](float Sample::*p) {
        return 0.25F * (top[0].*p + top[1].*p + bottom[0].*p + bottom[1].*p);
      };
      const float through = 1.0F - of(&Sample::solid);
      red[x] = through * red[x] + of(&Sample::red);
      green[x] = through * green[x] + of(&Sample::green);
      blue[x] = through * blue[x] + of(&Sample::blue);
    }
  }
}

}  // namespace

SeenSolid seen_from(const Solid& solid, const Eigen::Vector3f& eye, const Eigen::Matrix3f& cRe) {
  const Eigen::Vector3f to = cRe * (solid.centre() - eye);
  const float sine = std::min(0.99F, solid.radius_m() / std::max(0.01F, to.norm()));
  return {solid, {to.normalized(), std::sqrt(1.0F - sine * sine), sine}};
}

SolidsPainter::SolidsPainter(const Hall& hall, const RayTable& rays, const LightField& field)
    : hall_(hall), rays_(rays), field_(field) {
  for (int j = 0; j < rays.tiles_down(); ++j) {
    for (int i = 0; i < rays.tiles_across(); ++i) {
      const std::array corners{corner_ray(i, j).normalized(), corner_ray(i + 1, j).normalized(),
                               corner_ray(i, j + 1).normalized(), corner_ray(i + 1, j + 1).normalized()};
      Cone cone;
      cone.axis = (corners[0] + corners[1] + corners[2] + corners[3]).normalized();
      for (const auto& corner : corners) cone.cosine = std::min(cone.cosine, corner.dot(cone.axis));
      cone.sine = std::sqrt(std::max(0.0F, 1.0F - cone.cosine * cone.cosine));
      cones_.push_back(cone);
    }
  }
}

Eigen::Vector3f SolidsPainter::corner_ray(int i, int j) const {
  const auto r = field_.ray(field_.corner(i, j));
  return {r.x, r.y, r.z};
}

void SolidsPainter::choose(const std::vector<SeenSolid>& solids, int i, int j, std::vector<const Solid*>& near) const {
  near.clear();
  const Cone& tile = cones_[static_cast<std::size_t>(j * rays_.tiles_across() + i)];
  for (const SeenSolid& seen : solids) {
    if (tile.meets(seen.cone)) near.push_back(&seen.solid);
  }
}

bool SolidsPainter::lay_plain_hall(const IceView& view, int i, int j, Strip& strip) const {
  const std::array corners{corner_ray(i, j), corner_ray(i + 1, j), corner_ray(i, j + 1), corner_ray(i + 1, j + 1)};
  std::array<Hall::View, 4> seen;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto look = hall_.look(turned(view, corners[k]));
    if (!look || (k > 0 && look->material != seen[0].material)) return false;
    seen[k] = *look;
  }
  const auto half_way = [&corners](std::size_t a, std::size_t b) {
    return Eigen::Vector3f(0.5F * (corners[a] + corners[b]));
  };
  for (const Eigen::Vector3f& inner :
       {half_way(0, 3), half_way(0, 1), half_way(2, 3), half_way(0, 2), half_way(1, 3)}) {
    const auto look = hall_.look(turned(view, inner));
    if (!look || look->material != seen[0].material) return false;
  }
  const float light = field_.in_hall_light(field_.corner(i, j));
  for (int p = 0; p < 3; ++p) {
    const std::array at{light * part(seen[0].colour, p), light * part(seen[1].colour, p),
                        light * part(seen[2].colour, p), light * part(seen[3].colour, p)};
    for (int y = 0; y < tile_h; ++y) {
      const float down = (static_cast<float>(y) + 0.5F) / tile_h;
      const float left = at[0] + down * (at[2] - at[0]);
      const float slope = (at[1] + down * (at[3] - at[1]) - left) / tile_w;
      float* out = strip.row(p, y) + i * tile_w;
      for (int x = 0; x < tile_w; ++x) out[x] = left + slope * (static_cast<float>(x) + 0.5F);
    }
  }
  return true;
}

void SolidsPainter::lay(const IceView& view, int i, int j, const std::vector<const Solid*>& near, bool with_hall,
                        Strip& strip) const {
  Samples samples;
  const float light = field_.in_hall_light(field_.corner(i, j));
  for (int y = 0; y <= tile_h; ++y) {
    for (int x = 0; x <= tile_w; ++x) {
      const int u = i * tile_w + x - 1;
      const int v = j * tile_h + y - 1;
      const Ray ray = turned(view, {mean(rays_.x(u, v), rays_.x(u, v + 1)), mean(rays_.y(u, v), rays_.y(u, v + 1)),
                                    mean(rays_.z(u, v), rays_.z(u, v + 1))});
      auto hit = nearest_hit(ray, near);
      if (!hit && with_hall) {
        if (const auto look = hall_.look(ray)) hit = Hit{0.0F, look->colour};
      }
      if (!hit) continue;
      samples[static_cast<std::size_t>(y * samples_across + x)] = {light * hit->colour.red, light * hit->colour.green,
                                                                   light * hit->colour.blue, 1.0F};
    }
  }
  lay_over(samples, i, strip);
}

}  // namespace hogline::hw::sim
