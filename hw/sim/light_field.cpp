#include "hw/sim/light_field.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::hw::sim {
namespace {

constexpr float lamp_power = 60.0F;  // a lamp's brightness against a white surface under it
constexpr float walls_mirrored = 0.12F;
constexpr float normal_reflectance = 0.018F;  // of ice, straight from above

// One lamp's reflection on the ice, added to `gloss`: a spot about the mirrored lamp, smeared by the pebble's slopes,
// more along the line of sight than across it.
struct Lamp {
  float x, y, half_x, half_y;
};

void mirror(const Lamp& lamp, const IceView& view, float height, float roughness, float power, int n, const float* sx,
            const float* sy, float* gloss) {
  const float h = view.height_m;
  for (int i = 0; i < n; ++i) {
    const float ax = sx[i] - view.x_m;
    const float ay = sy[i] - view.y_m;
    const float rho2 = ax * ax + ay * ay + 1e-6F;
    const float slant2 = rho2 + h * h;
    const float slant = std::sqrt(slant2);
    const float up = height / h;
    const float ex = sx[i] + up * ax - lamp.x;
    const float ey = sy[i] + up * ay - lamp.y;
    const float along = ex * ax + ey * ay;
    const float cross = ex * ay - ey * ax;
    const float across = 2.0F * roughness * slant * up;
    const float length = across * slant / h;
    const float wide2 = across * across + lamp.half_x * lamp.half_x;
    const float long2 = length * length + lamp.half_y * lamp.half_y;
    const float q = 1.0F + (along * along / long2 + cross * cross / wide2) / rho2;
    const float grazing = 1.0F - h / slant;
    const float g2 = grazing * grazing;
    const float fresnel = normal_reflectance + (1.0F - normal_reflectance) * g2 * g2 * grazing;
    gloss[i] += power * fresnel * lamp.half_x * lamp.half_y / std::sqrt(wide2 * long2) / (q * q);
  }
}

}  // namespace

LightField::LightField(const RayTable& rays, const vision::Intrinsics& intrinsics, const LightAppearance& light,
                       const Hall& hall)
    : appearance_(light), hall_(hall), across_(rays.tiles_across() + 1) {
  const double corner2 =
      0.25 * (intrinsics.width_px * intrinsics.width_px + intrinsics.height_px * intrinsics.height_px);
  for (int j = 0; j <= rays.tiles_down(); ++j) {
    for (int i = 0; i < across_; ++i) {
      const int u = i * RayTable::tile_width - 1;
      const int v = j * RayTable::tile_height - 1;
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      bool valid = true;
      for (const auto& [du, dv] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
        const Eigen::Vector3f ray(*rays.x(u + du, v + dv), *rays.y(u + du, v + dv), *rays.z(u + du, v + dv));
        valid = valid && !ray.isZero(0.0F);
        sum += 0.25F * ray;
      }
      rx_.push_back(sum.x());
      ry_.push_back(sum.y());
      rz_.push_back(sum.z());
      valid_.push_back(valid ? 1 : 0);
      const double du = u + 0.5 - 0.5 * (intrinsics.width_px - 1);
      const double dv = v + 0.5 - 0.5 * (intrinsics.height_px - 1);
      vignette_.push_back(
          static_cast<float>(light.level * (1.0 - light.vignetting * std::min(1.0, (du * du + dv * dv) / corner2))));
    }
  }
  for (auto* plane : {&sx_, &sy_, &px_, &py_, &smear_x_, &smear_y_, &light_, &gloss_, &ax_, &ay_, &bx_, &by_,
                      &unused_x_, &unused_y_, &descent_}) {
    plane->assign(rx_.size(), 0.0F);
  }
  on_ice_.assign(rx_.size(), 0);
}

void LightField::look(const IceView& view, const IceView& begin, const IceView& end, bool moving) {
  const int n = static_cast<int>(rx_.size());
  trace_ice(view, rx_.data(), ry_.data(), rz_.data(), n, sx_.data(), sy_.data(), px_.data(), py_.data(),
            descent_.data());
  if (moving) {
    trace_ice(begin, rx_.data(), ry_.data(), rz_.data(), n, unused_x_.data(), unused_y_.data(), ax_.data(), ay_.data(),
              descent_.data());
    trace_ice(end, rx_.data(), ry_.data(), rz_.data(), n, unused_x_.data(), unused_y_.data(), bx_.data(), by_.data(),
              descent_.data());
  }
  const IceBounds& ice = hall_.ice();
  const auto falloff = static_cast<float>(appearance_.falloff_per_m);
  for (std::size_t k = 0; k < rx_.size(); ++k) {
    smear_x_[k] = moving ? bx_[k] - ax_[k] : 0.0F;
    smear_y_[k] = moving ? by_[k] - ay_[k] : 0.0F;
    const bool inside = sx_[k] > ice.x0_m && sx_[k] < ice.x1_m && sy_[k] > ice.y0_m && sy_[k] < ice.y1_m;
    on_ice_[k] = inside && valid_[k] != 0 ? 1 : 0;
    const float x = std::clamp(sx_[k], ice.x0_m, ice.x1_m);
    light_[k] = vignette_[k] * std::max(0.0F, 1.0F + falloff * x);
  }
  mirror_lamps(view);
}

void LightField::mirror_lamps(const IceView& view) {
  const int n = static_cast<int>(rx_.size());
  std::fill(gloss_.begin(), gloss_.end(), 0.0F);
  if (appearance_.lamp_gloss > 0.0) {
    const HallAppearance& hall = hall_.appearance();
    const auto spacing = static_cast<float>(hall.lamp_spacing_m);
    const auto power = lamp_power * static_cast<float>(appearance_.lamp_gloss);
    for (float y = (std::floor(hall_.ice().y0_m / spacing) + 0.5F) * spacing; y < hall_.ice().y1_m; y += spacing) {
      for (const float x : hall_.lamp_columns_m()) {
        const Lamp lamp{x, y, 0.5F * static_cast<float>(hall.lamp_width_m),
                        0.5F * static_cast<float>(hall.lamp_length_m)};
        mirror(lamp, view, static_cast<float>(hall.height_m), static_cast<float>(appearance_.roughness_rad), power, n,
               sx_.data(), sy_.data(), gloss_.data());
      }
    }
  }
  for (std::size_t k = 0; k < gloss_.size(); ++k) {
    const float ax = sx_[k] - view.x_m;
    const float ay = sy_[k] - view.y_m;
    const float grazing = 1.0F - view.height_m / std::sqrt(ax * ax + ay * ay + view.height_m * view.height_m);
    const float g2 = grazing * grazing;
    gloss_[k] = vignette_[k] * (gloss_[k] + walls_mirrored * g2 * g2 * grazing);
  }
}

}  // namespace hogline::hw::sim
