#include <algorithm>
#include <cmath>
#include <cstdint>

#include "hw/sim/solids.hpp"

namespace hogline::hw::sim {
namespace {

constexpr float lamp_brightness = 1.6F;
constexpr float never = 1e9F;

Colour scaled(const Colour& c, float by) { return {c.red * by, c.green * by, c.blue * by}; }

std::uint32_t scrambled(std::uint32_t v) {
  v = (v ^ (v >> 16)) * 0x45d9f3bU;
  v = (v ^ (v >> 16)) * 0x45d9f3bU;
  return v ^ (v >> 16);
}

// The colour of a panel, and none for the gaps between them.
std::optional<Colour> panel(int side, int number) {
  const std::uint32_t h = scrambled(static_cast<std::uint32_t>(number * 8 + side + 1000));
  if (h % 5 < 2) return std::nullopt;
  const auto part = [h](int shift) { return 0.03F + 0.5F * static_cast<float>((h >> shift) & 15U) / 15.0F; };
  return Colour{part(8), part(12), part(16)};
}

// Where a ray leaves an upright box from inside: through which side (-x, +x, -y, +y) and after how many lengths.
struct Exit {
  int side;
  float distance;
};

Exit way_out(const Ray& ray, const IceBounds& box, float wider_m) {
  const Eigen::Vector3f& o = ray.origin;
  const Eigen::Vector3f& d = ray.direction;
  const float x = d.x() > 0.0F ? box.x1_m + wider_m : box.x0_m - wider_m;
  const float y = d.y() > 0.0F ? box.y1_m + wider_m : box.y0_m - wider_m;
  const float to_x = d.x() == 0.0F ? never : (x - o.x()) / d.x();
  const float to_y = d.y() == 0.0F ? never : (y - o.y()) / d.y();
  if (to_x < to_y) return {d.x() > 0.0F ? 1 : 0, to_x};
  return {d.y() > 0.0F ? 3 : 2, to_y};
}

}  // namespace

Hall::Hall(const HallAppearance& look, const IceBounds& bounds)
    : look_(look), ice_(bounds), lamp_columns_m_{bounds.x0_m * 0.6F, 0.0F, bounds.x1_m * 0.6F} {}

Hall::View Hall::boards(int side, float z_m) const {
  const float share = z_m / static_cast<float>(look_.board_height_m);
  return {scaled(look_.boards, 0.6F + 0.4F * share), 16 + side};
}

Hall::View Hall::wall(int side, float along_m, float z_m) const {
  const bool end = side >= 2;
  const float low = end ? 0.9F : 0.3F;
  if (look_.panels && z_m > low && z_m < low + 0.8F) {
    const float cell = along_m / 1.6F;
    const int number = static_cast<int>(std::floor(cell));
    const float within = cell - static_cast<float>(number);
    if (within > 0.08F && within < 0.92F) {
      if (const auto colour = panel(side, number)) return {*colour, 1024 + side * 1024 + (number & 1023)};
    }
  }
  const float share = z_m / static_cast<float>(look_.height_m);
  return {scaled(look_.walls, 1.2F - 0.5F * share), 64 + side};
}

Hall::View Hall::ceiling(float x_m, float y_m) const {
  const auto spacing = static_cast<float>(look_.lamp_spacing_m);
  const float row = std::round((y_m - 0.5F * spacing) / spacing);
  const float off_y = y_m - (row + 0.5F) * spacing;
  for (const float column : lamp_columns_m_) {
    const bool lit = std::abs(x_m - column) < 0.5F * static_cast<float>(look_.lamp_width_m) &&
                     std::abs(off_y) < 0.5F * static_cast<float>(look_.lamp_length_m);
    if (lit) return {{lamp_brightness, lamp_brightness, lamp_brightness}, 8};
  }
  return {look_.ceiling, 9};
}

std::optional<Hall::View> Hall::look(const Ray& ray) const {
  const Eigen::Vector3f& o = ray.origin;
  const Eigen::Vector3f& d = ray.direction;
  if (d.isZero(0.0F)) return View{{}, 1};

  const Exit edge = way_out(ray, ice_, 0.0F);
  const float edge_z = o.z() + edge.distance * d.z();
  if (edge_z < 0.0F) return std::nullopt;
  if (edge_z < static_cast<float>(look_.board_height_m)) return boards(edge.side, edge_z);

  const Exit out = way_out(ray, ice_, static_cast<float>(look_.walkway_m));
  const float level = d.z() < 0.0F ? 0.0F : static_cast<float>(look_.height_m);
  const float to_level = d.z() == 0.0F ? never : (level - o.z()) / d.z();
  const Eigen::Vector3f p = o + std::min(out.distance, to_level) * d;
  if (to_level < out.distance) return d.z() < 0.0F ? View{look_.floor, 10} : ceiling(p.x(), p.y());
  return wall(out.side, out.side < 2 ? p.y() : p.x(), p.z());
}

}  // namespace hogline::hw::sim
