#include "hw/sim/ice_tile.hpp"

#include <cassert>
#include <cmath>

namespace hogline::hw::sim {
namespace {

// An edge is drawn as 3t^2 - 2t^3, whose derivative has the variance width^2 / 20.
constexpr float profile_variance = 20.0F;
// An exposure's smear is a box, of variance width^2 / 12.
constexpr float box_variance = 12.0F;
constexpr float tiny = 1e-20F;
constexpr float least_descent = 1e-4F;  // of a ray, in lengths of its direction

// 0 to 1 as `s`, in widths of the edge, goes from -1/2 to 1/2.
inline float step(float s) {
  const float t = s + 0.5F;
  const float low = t > 0.0F ? t : 0.0F;
  const float c = low < 1.0F ? low : 1.0F;
  return c * c * (3.0F - 2.0F * c);
}

// How many of its widths an edge is away whose paint lies `d` metres off. A straight edge of paint is straight in the
// picture, so D * d is linear there (D: the ray's descent); `shrink` is how fast ln D changes per metre.
inline float widths(float d, float sharp, float shrink) {
  const float scale = 1.0F + d * shrink;
  return d * sharp / (scale > 0.5F ? scale : 0.5F);
}

// A wave of parabolas: as a sine to 6 %, without a library call.
inline float wave(float phase) {
  const float p = phase + 1024.0F;
  const float within = p - static_cast<float>(static_cast<int>(p));
  const float s = 2.0F * within - 1.0F;
  const float size = s > 0.0F ? s : -s;
  return 4.0F * s * (size - 1.0F);
}

}  // namespace

IceView::IceView(const vision::Pose& eMc, const vision::Ice& ice)
    : x_m(static_cast<float>(eMc.translation().x())),
      y_m(static_cast<float>(eMc.translation().y())),
      height_m(static_cast<float>(eMc.translation().z())),
      paint_depth_m(static_cast<float>(ice.paint_depth_m)),
      index2(static_cast<float>(ice.refractive_index * ice.refractive_index)) {
  assert(eMc.translation().z() > 0.0);
  for (int i = 0; i < 9; ++i) eRc[static_cast<std::size_t>(i)] = static_cast<float>(eMc.linear()(i / 3, i % 3));
}

// tan of the angle in the ice is rho / sqrt((n^2 - 1) rho^2 + n^2 down^2) for a ray that goes rho sideways and down.
void trace_ice(const IceView& view, const float* rx, const float* ry, const float* rz, int n, float* surface_x,
               float* surface_y, float* paint_x, float* paint_y, float* descent) {
  const auto [r0, r1, r2, r3, r4, r5, r6, r7, r8] = view.eRc;
  const float h = view.height_m;
  const float depth = view.paint_depth_m;
  const float n2 = view.index2;
  const float cx = view.x_m;
  const float cy = view.y_m;
  for (int i = 0; i < n; ++i) {
    const float dx = r0 * rx[i] + r1 * ry[i] + r2 * rz[i];
    const float dy = r3 * rx[i] + r4 * ry[i] + r5 * rz[i];
    const float dz = r6 * rx[i] + r7 * ry[i] + r8 * rz[i];
    const float down = -dz > least_descent ? -dz : least_descent;
    const float reach = h / down;
    descent[i] = down;
    const float below = depth / std::sqrt((n2 - 1.0F) * (dx * dx + dy * dy) + n2 * down * down);
    surface_x[i] = cx + reach * dx;
    surface_y[i] = cy + reach * dy;
    paint_x[i] = surface_x[i] + below * dx;
    paint_y[i] = surface_y[i] + below * dy;
  }
}

void IceTile::aim(const IceView& view, const RayTable& rays, int u, int v, const Smear& smear, float edge_variance) {
  alignas(16) std::array<float, grid_size> rx, ry, rz, sx, sy, px, py, descent;
  for (int j = 0; j < height + 2; ++j) {
    const float* from_x = rays.x(u - 1, v - 1 + j);
    const float* from_y = rays.y(u - 1, v - 1 + j);
    const float* from_z = rays.z(u - 1, v - 1 + j);
    for (int i = 0; i < grid_width; ++i) {
      const auto k = static_cast<std::size_t>(j * grid_width + i);
      rx[k] = from_x[i];
      ry[k] = from_y[i];
      rz[k] = from_z[i];
    }
  }
  trace_ice(view, rx.data(), ry.data(), rz.data(), grid_size, sx.data(), sy.data(), px.data(), py.data(),
            descent.data());

  smear_ = smear;
  spread_ = profile_variance * edge_variance;
  x_is_sharp_ = y_is_sharp_ = false;
  for (int j = 0; j < height; ++j) {
    const auto first = static_cast<std::size_t>((j + 1) * grid_width + 1);
    const float* X = &px[first];
    const float* Y = &py[first];
    const float* D = &descent[first];
    const auto row = static_cast<std::size_t>(j * width);
    for (int i = 0; i < width; ++i) {
      const std::size_t k = row + static_cast<std::size_t>(i);
      x_[k] = X[i];
      y_[k] = Y[i];
      surface_x_[k] = sx[first + static_cast<std::size_t>(i)];
      surface_y_[k] = sy[first + static_cast<std::size_t>(i)];
      x_by_u_[k] = 0.5F * (X[i + 1] - X[i - 1]);
      x_by_v_[k] = 0.5F * (X[i + grid_width] - X[i - grid_width]);
      y_by_u_[k] = 0.5F * (Y[i + 1] - Y[i - 1]);
      y_by_v_[k] = 0.5F * (Y[i + grid_width] - Y[i - grid_width]);
      const float by_descent = 0.5F / D[i];
      fall_by_u_[k] = by_descent * (D[i + 1] - D[i - 1]);
      fall_by_v_[k] = by_descent * (D[i + grid_width] - D[i - grid_width]);
    }
  }
}

void IceTile::sharpen(const Pixels& by_u, const Pixels& by_v, float smear_m, Pixels& sharp, Pixels& shrink) const {
  const float more = profile_variance / box_variance * smear_m * smear_m;
  for (std::size_t k = 0; k < size; ++k) {
    const float slope2 = by_u[k] * by_u[k] + by_v[k] * by_v[k];
    sharp[k] = 1.0F / std::sqrt(spread_ * slope2 + more);
    shrink[k] = (fall_by_u_[k] * by_u[k] + fall_by_v_[k] * by_v[k]) / (slope2 + tiny);
  }
}

void IceTile::fill(const Colour& colour) {
  red_.fill(colour.red);
  green_.fill(colour.green);
  blue_.fill(colour.blue);
}

void IceTile::blend(const Pixels& coverage, const Colour& colour) {
  for (std::size_t k = 0; k < size; ++k) {
    red_[k] += coverage[k] * (colour.red - red_[k]);
    green_[k] += coverage[k] * (colour.green - green_[k]);
    blue_[k] += coverage[k] * (colour.blue - blue_[k]);
  }
}

void IceTile::paint_disc(float x_m, float y_m, float radius_m, const Colour& colour) {
  alignas(16) Pixels coverage;
  constexpr float smear_share = profile_variance / box_variance;
  for (std::size_t k = 0; k < size; ++k) {
    const float dx = x_[k] - x_m;
    const float dy = y_[k] - y_m;
    const float r = std::sqrt(dx * dx + dy * dy + 1e-9F);
    const float ru = (dx * x_by_u_[k] + dy * y_by_u_[k]) / r;
    const float rv = (dx * x_by_v_[k] + dy * y_by_v_[k]) / r;
    const float rs = (dx * smear_.x_m + dy * smear_.y_m) / r;
    coverage[k] = step((radius_m - r) / std::sqrt(spread_ * (ru * ru + rv * rv) + smear_share * rs * rs));
  }
  blend(coverage, colour);
}

void IceTile::paint_rect(const PaintedRect& rect, bool on_surface, bool ends_in_x, bool ends_in_y) {
  alignas(16) Pixels coverage;
  coverage.fill(1.0F);
  const Pixels& x = on_surface ? surface_x_ : x_;
  const Pixels& y = on_surface ? surface_y_ : y_;
  if (ends_in_x) {
    if (!x_is_sharp_) sharpen(x_by_u_, x_by_v_, smear_.x_m, sharp_x_, shrink_x_);
    x_is_sharp_ = true;
    const float phase = 1.0F / rect.wavelength_m;
    for (std::size_t k = 0; k < size; ++k) {
      const float at = x[k] - rect.sway_m * wave(y[k] * phase);
      coverage[k] = step(widths(at - rect.x0_m, sharp_x_[k], shrink_x_[k])) -
                    step(widths(at - rect.x1_m, sharp_x_[k], shrink_x_[k]));
    }
  }
  if (ends_in_y) {
    if (!y_is_sharp_) sharpen(y_by_u_, y_by_v_, smear_.y_m, sharp_y_, shrink_y_);
    y_is_sharp_ = true;
    for (std::size_t k = 0; k < size; ++k) {
      coverage[k] *= step(widths(y[k] - rect.y0_m, sharp_y_[k], shrink_y_[k])) -
                     step(widths(y[k] - rect.y1_m, sharp_y_[k], shrink_y_[k]));
    }
  }
  blend(coverage, rect.colour);
}

void IceTile::shade(float x_m, float y_m, float radius_m, float strength) {
  const float by_r2 = 1.0F / (radius_m * radius_m);
  for (std::size_t k = 0; k < size; ++k) {
    const float dx = surface_x_[k] - x_m;
    const float dy = surface_y_[k] - y_m;
    const float q = 1.0F - (dx * dx + dy * dy) * by_r2;
    const float depth = q > 0.0F ? q : 0.0F;
    const float left = 1.0F - strength * depth * depth;
    red_[k] *= left;
    green_[k] *= left;
    blue_[k] *= left;
  }
}

}  // namespace hogline::hw::sim
