#include "vision/fit/grip_model.hpp"

#include <cmath>

namespace hogline::vision {
namespace {

constexpr float least_px = 1e-6F;
constexpr float ramp_widths = 3.46F;  // a ramp's width, in deviations of the blur it stands for

/// A strip of the given half width about 0, through a blur: edges are ramps. A call would cost as much as its work.
[[gnu::always_inline]] inline Four strip(const Four& at, float half, float per_width) {
  const float inside = half * per_width + 0.5F;
  return (inside - at * per_width).max(0.0F).min(1.0F) + (inside + at * per_width).max(0.0F).min(1.0F) - 1.0F;
}

/// One of the bar's own axes at a stance: u along it, v to its left.
struct Axis {
  Eigen::Vector2f along;
  float lift_x, lift_y;
  float away;
  float per_width;  ///< ramps' widths per metre

  Axis(const Eigen::Vector2f& direction, const GripSights& sights, const GripStance& stance, float blur_px)
      : along(direction),
        lift_x(-stance.raised_m * sights.away.x()),
        lift_y(-stance.raised_m * sights.away.y()),
        away(direction.dot(sights.away)),
        per_width(1.0F /
                  (ramp_widths * blur_px * std::max(least_px, (sights.by_pixel.transpose() * direction).norm()))) {}

  Four at(const Four& x, const Four& y) const { return along.x() * (x + lift_x) + along.y() * (y + lift_y); }
};

/// An upright face across `a` at `front` (from the middle towards the eye), between two depths below the bar's top, and
/// within `half` about `middle` along `b`.
class Face {
 public:
  struct Place {
    float front, from_m, to_m, middle, half;
  };
  Face(const Place& place, const Axis& a, const Axis& b)
      : place_(place),
        descent_(std::max(1e-4F, std::abs(a.away))),
        sense_(a.away < 0.0F ? -1.0F : 1.0F),
        away_b_(b.away),
        per_width_a_(a.per_width),
        per_width_b_(b.per_width) {}

  Four cover(const Four& a, const Four& b) const {
    // A line of sight that passes `a` at the top's level meets the face this far below it.
    const Four below = (-place_.front - sense_ * a) / descent_;
    const float middle_m = 0.5F * (place_.from_m + place_.to_m);
    const float half_m = 0.5F * (place_.to_m - place_.from_m);
    const Four at = b + away_b_ * below.max(place_.from_m).min(place_.to_m) - place_.middle;
    return strip(descent_ * (below - middle_m), descent_ * half_m, per_width_a_) * strip(at, place_.half, per_width_b_);
  }

 private:
  Place place_;
  float descent_;
  float sense_;
  float away_b_;
  float per_width_a_;
  float per_width_b_;
};

}  // namespace

void cover_by_grip(const GripSights& sights, const GripShape& shape, const GripStance& stance, float blur_px,
                   GripCover& cover) {
  const float c = std::cos(stance.turn_rad);
  const float s = std::sin(stance.turn_rad);
  const Axis along({-s, c}, sights, stance, blur_px);
  const Axis across({-c, -s}, sights, stance, blur_px);
  const float length = static_cast<float>(shape.half_length_m) + stance.longer_m;
  const auto width = static_cast<float>(shape.half_width_m);
  const auto thick = static_cast<float>(shape.top_m - shape.bottom_m);
  const float high = static_cast<float>(shape.top_m) + stance.raised_m;
  const float neck_front = width + (along.away > 0.0F ? -stance.neck_m : stance.neck_m);

  const Face long_side({width, 0.0F, thick, 0.0F, length}, across, along);
  const Face end({length, 0.0F, thick, 0.0F, width}, along, across);
  const Face neck_side({width, thick, high, stance.neck_m, width}, across, along);
  const Face neck_end({neck_front, thick, high, 0.0F, width}, along, across);

  cover.top.resize(sights.x.size());
  cover.side.resize(sights.x.size());
  for (Eigen::Index i = 0; i < sights.x.size(); i += 4) {
    const Four u = along.at(four(sights.x, i), four(sights.y, i));
    const Four v = across.at(four(sights.x, i), four(sights.y, i));
    const Four top = strip(u, length, along.per_width) * strip(v, width, across.per_width);
    const Four side = long_side.cover(v, u) + end.cover(u, v);
    const Four neck = neck_side.cover(v, u) + neck_end.cover(u, v);
    four(cover.top, i) = top;
    four(cover.side, i) = side + (1.0F - top - side).max(0.0F) * neck;
  }
}

}  // namespace hogline::vision
