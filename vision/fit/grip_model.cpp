#include "vision/fit/grip_model.hpp"

#include <cmath>

namespace hogline::vision {
namespace {

constexpr float least_px = 1e-6F;
constexpr float ramp_widths = 3.46F;  // a ramp's width, in deviations of the blur it stands for

/// A strip of the given half width about 0, through a blur: edges are ramps.
Pixels strip(const Pixels& at, float half, float per_width) {
  const float inside = half * per_width + 0.5F;
  return (inside - at * per_width).max(0.0F).min(1.0F) + (inside + at * per_width).max(0.0F).min(1.0F) - 1.0F;
}

/// The bar's own axes at a stance: u along it, v to its left.
struct BarAxes {
  Pixels u, v;
  float away_u, away_v;
  float per_width_u, per_width_v;  ///< ramps' widths per metre

  BarAxes(const GripSights& sights, const GripStance& stance, float blur_px) {
    const float c = std::cos(stance.turn_rad);
    const float s = std::sin(stance.turn_rad);
    const Eigen::Vector2f along(-s, c);
    const Eigen::Vector2f left(-c, -s);
    const Eigen::Vector2f lift = -stance.raised_m * sights.away;
    u = along.x() * (sights.x + lift.x()) + along.y() * (sights.y + lift.y());
    v = left.x() * (sights.x + lift.x()) + left.y() * (sights.y + lift.y());
    away_u = along.dot(sights.away);
    away_v = left.dot(sights.away);
    const float width_px = ramp_widths * blur_px;
    per_width_u = 1.0F / (width_px * std::max(least_px, (sights.by_pixel.transpose() * along).norm()));
    per_width_v = 1.0F / (width_px * std::max(least_px, (sights.by_pixel.transpose() * left).norm()));
  }
};

/// An upright face across `a` at `front` (from the middle towards the eye), between two depths below the bar's top, and
/// within `half` about `middle` along `b`.
struct Face {
  float front, from_m, to_m, middle, half;
};

Pixels upright(const Face& face, const Pixels& a, float away_a, float per_width_a, const Pixels& b, float away_b,
               float per_width_b) {
  const float descent = std::max(1e-4F, std::abs(away_a));
  const float sense = away_a < 0.0F ? -1.0F : 1.0F;
  // A line of sight that passes `a` at the top's level meets the face this far below it.
  const Pixels below = (-face.front - sense * a) / descent;
  const float middle_m = 0.5F * (face.from_m + face.to_m);
  const float half_m = 0.5F * (face.to_m - face.from_m);
  const Pixels at = b + away_b * below.max(face.from_m).min(face.to_m) - face.middle;
  return strip(descent * (below - middle_m), descent * half_m, per_width_a) * strip(at, face.half, per_width_b);
}

}  // namespace

void cover_by_grip(const GripSights& sights, const GripShape& shape, const GripStance& stance, float blur_px,
                   GripCover& cover) {
  const BarAxes bar(sights, stance, blur_px);
  const float length = static_cast<float>(shape.half_length_m) + stance.longer_m;
  const auto width = static_cast<float>(shape.half_width_m);
  const auto thick = static_cast<float>(shape.top_m - shape.bottom_m);
  const float high = static_cast<float>(shape.top_m) + stance.raised_m;

  cover.top = strip(bar.u, length, bar.per_width_u) * strip(bar.v, width, bar.per_width_v);
  const Face long_side{width, 0.0F, thick, 0.0F, length};
  const Face end{length, 0.0F, thick, 0.0F, width};
  cover.side = upright(long_side, bar.v, bar.away_v, bar.per_width_v, bar.u, bar.away_u, bar.per_width_u) +
               upright(end, bar.u, bar.away_u, bar.per_width_u, bar.v, bar.away_v, bar.per_width_v);

  const Face neck_side{width, thick, high, stance.neck_m, width};
  const float neck_front = width + (bar.away_u > 0.0F ? -stance.neck_m : stance.neck_m);
  const Face neck_end{neck_front, thick, high, 0.0F, width};
  const Pixels neck = upright(neck_side, bar.v, bar.away_v, bar.per_width_v, bar.u, bar.away_u, bar.per_width_u) +
                      upright(neck_end, bar.u, bar.away_u, bar.per_width_u, bar.v, bar.away_v, bar.per_width_v);
  cover.side += (1.0F - cover.top - cover.side).max(0.0F) * neck;
}

}  // namespace hogline::vision
