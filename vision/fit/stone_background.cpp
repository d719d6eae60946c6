#include <algorithm>
#include <cmath>

#include "vision/fit/stone_patch.hpp"

namespace hogline::vision {
namespace {

constexpr float reach_px = 4.0F;      // deeper inside the outline nothing behind shines through
constexpr float clearance_px = 2.8F;  // beyond the outline the stone's light has faded
constexpr float grip_m = 0.06F;

struct Point {
  float x, y;
  Point ahead(float px, const Point& direction) const { return {x + px * direction.x, y + px * direction.y}; }
};

/// The mean of three samples a pixel apart; false where the picture ends.
bool mean_light(const PatchSource& source, const Point& from, const Point& step, Eigen::Array3f& mean) {
  mean.setZero();
  for (int i = 0; i < 3; ++i) {
    const Point p = from.ahead(static_cast<float>(i), step);
    Eigen::Array3f light;
    if (!source.at(p.x, p.y, light)) return false;
    mean += light / 3.0F;
  }
  return true;
}

/// What is to the left and right of a stone, row by row.
class Sides {
 public:
  Sides(const PatchSource& source, const StonePixels& pixels)
      : source_(source), left_(pixels.x.minCoeff()), right_(pixels.x.maxCoeff()) {}

  /// Between the two sides where they agree; nothing where they do not.
  bool at(const Point& pixel, Eigen::Array3f& light) const {
    Eigen::Array3f left;
    Eigen::Array3f right;
    if (!mean_light(source_, {left_, pixel.y}, {-1.0F, 0.0F}, left)) return false;
    if (!mean_light(source_, {right_, pixel.y}, {1.0F, 0.0F}, right)) return false;
    if ((left - right).matrix().norm() > 0.15F + 0.15F * (left + right).matrix().norm()) return false;
    const float part = (pixel.x - left_) / std::max(1.0F, right_ - left_);
    light = left + part * (right - left);
    return true;
  }

 private:
  const PatchSource& source_;
  float left_;
  float right_;
};

/// There is something of the handle's colour over the rim: its grip.
bool grip_over(const PatchSource& source, const Point& rim, const Point& outward, float far_px,
               const Eigen::Array3f& handle, const Eigen::Array3f& behind) {
  const Eigen::Array3f change = handle - behind;
  const float size = change.matrix().norm();
  if (size < 0.1F) return true;  // it could not be told
  for (float px = 1.2F; px < far_px; px += 1.0F) {
    const Point p = rim.ahead(px, outward);
    Eigen::Array3f light;
    if (!source.at(p.x, p.y, light)) return true;
    const Eigen::Array3f difference = light - behind;
    const float part = (difference * change).sum() / (size * size);
    const float other = (difference - part * change).matrix().norm();
    const float fading = px < 2.0F ? 0.2F : 0.0F;  // of the rim itself
    if (part > 0.25F + fading && other < 0.6F * part * size) return true;
  }
  return false;
}

/// Pixels that the grip's height takes in the picture.
float grip_px(const SightLines& sights, Eigen::Index i, double eye_m) {
  const float per_px = static_cast<float>(eye_m) * std::hypot(sights.x_by_column[i], sights.y_by_column[i]);
  return std::clamp(grip_m / std::max(1e-9F, per_px), 2.5F, 12.0F);
}

}  // namespace

void look_behind(const PatchSource& source, const StonePlace& stone, const Eigen::Vector3d& eye,
                 const Light& handle_colour, StonePixels& pixels) {
  if (pixels.count() == 0) return;
  DiscDistances handle;
  BodyDistances body;
  handle_distances(stone, eye, pixels.sights, handle);
  body_distances(stone, eye, pixels.sights, body);
  const Sides sides(source, pixels);
  const Eigen::Array3f colour = handle_colour.cast<float>().array();
  const bool coloured = handle_colour.squaredNorm() > 0.0;
  pixels.usable.setOnes();
  pixels.behind.setZero();
  for (Eigen::Index i = 0; i < pixels.count(); ++i) {
    const bool far_rim = handle.px[i] > body.px[i];
    const float px = far_rim ? handle.px[i] : body.px[i];
    if (px > reach_px) continue;
    const Point outward =
        far_rim ? Point{handle.outward_x[i], handle.outward_y[i]} : Point{body.outward_x[i], body.outward_y[i]};
    const Point rim = Point{pixels.x[i], pixels.y[i]}.ahead(px, outward);
    const Point beyond = rim.ahead(clearance_px, outward);
    Eigen::Array3f behind;
    const bool known = (far_rim && sides.at(beyond, behind)) || mean_light(source, beyond, outward, behind);
    if (known) pixels.behind.row(i) = behind.transpose();
    const bool grip = known && far_rim && coloured &&
                      grip_over(source, rim, outward, grip_px(pixels.sights, i, eye.z()), colour, behind);
    pixels.usable[i] = known && !grip ? 1.0F : 0.0F;
  }
}

}  // namespace hogline::vision
