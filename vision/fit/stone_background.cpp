#include <algorithm>
#include <array>
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

bool mean_light(const PatchSource& source, const Point& from, const Point& step, Eigen::Array3f& mean) {
  return source.mean_of_three(from.x, from.y, step.x, step.y, mean);
}

/// What is to the left and right of a stone, row by row: each row is looked at once, for all that asks for it.
class Sides {
 public:
  Sides(const PatchSource& source, const StonePixels& pixels)
      : source_(source),
        left_(static_cast<int>(pixels.x.minCoeff())),
        right_(static_cast<int>(pixels.x.maxCoeff())),
        in_picture_(source.holds(left_ - samples + 1, 0) && source.holds(right_ + samples, 0)) {
    for (Row& row : rows_) row.number = -1;
  }

  /// Between the two sides where they agree; nothing where they do not.
  bool at(const Point& pixel, Eigen::Array3f& light) {
    if (!in_picture_ || !(pixel.y >= 0.0F) || !source_.holds(left_, static_cast<int>(pixel.y) + 1)) return false;
    const int above = static_cast<int>(pixel.y);
    const float v = pixel.y - static_cast<float>(above);
    const Row& top = row(above);
    const Row& low = row(above + 1);
    const Eigen::Array4f left = top.left + v * (low.left - top.left);
    const Eigen::Array4f right = top.right + v * (low.right - top.right);
    if ((left - right).matrix().norm() > 0.15F + 0.15F * (left + right).matrix().norm()) return false;
    const float part = (pixel.x - static_cast<float>(left_)) / std::max(1.0F, static_cast<float>(right_ - left_));
    light = (left + part * (right - left)).head<3>();
    return true;
  }

 private:
  static constexpr int samples = 3;
  static constexpr std::size_t kept_rows = 64;
  struct Row {
    int number;
    Eigen::Array4f left, right;
  };

  const Row& row(int number) {
    Row& kept = rows_[static_cast<std::size_t>(number) % kept_rows];
    if (kept.number == number) return kept;
    kept.number = number;
    kept.left = kept.right = Eigen::Array4f::Zero();
    for (int i = 0; i < samples; ++i) {
      kept.left += source_.padded(left_ - i, number);
      kept.right += source_.padded(right_ + i, number);
    }
    kept.left /= static_cast<float>(samples);
    kept.right /= static_cast<float>(samples);
    return kept;
  }

  const PatchSource& source_;
  int left_;
  int right_;
  bool in_picture_;
  std::array<Row, kept_rows> rows_;
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

/// Where a pixel's outline is, outward of it in the picture.
struct Rim {
  Point at;
  Point outward;
};

class Outline {
 public:
  Outline(const DiscDistances& handle, const BodyDistances& body, const StonePixels& pixels)
      : pixels_(pixels), handle_(handle), body_(body) {}
  bool on_far_rim(Eigen::Index i) const { return handle_.px[i] > body_.px[i]; }
  float inside_px(Eigen::Index i) const { return std::max(handle_.px[i], body_.px[i]); }
  Rim rim(Eigen::Index i) const {
    const Point outward = on_far_rim(i) ? Point{handle_.outward_x[i], handle_.outward_y[i]}
                                        : Point{body_.outward_x[i], body_.outward_y[i]};
    return {Point{pixels_.x[i], pixels_.y[i]}.ahead(inside_px(i), outward), outward};
  }

 private:
  const StonePixels& pixels_;
  const DiscDistances& handle_;
  const BodyDistances& body_;
};

}  // namespace

void look_behind(const PatchSource& source, const DiscDistances& handle, const BodyDistances& body,
                 StonePixels& pixels) {
  if (pixels.count() == 0) return;
  const Outline outline(handle, body, pixels);
  Sides sides(source, pixels);
  pixels.usable.setOnes();
  pixels.behind.setZero();
  for (Eigen::Index i = 0; i < pixels.count(); ++i) {
    if (outline.inside_px(i) > reach_px) continue;
    const Rim rim = outline.rim(i);
    const Point beyond = rim.at.ahead(clearance_px, rim.outward);
    Eigen::Array3f behind;
    const bool known =
        (outline.on_far_rim(i) && sides.at(beyond, behind)) || mean_light(source, beyond, rim.outward, behind);
    if (known) pixels.behind.row(i) = behind.transpose();
    pixels.usable[i] = known ? 1.0F : 0.0F;
  }
}

void leave_out_grip(const PatchSource& source, const DiscDistances& handle, const BodyDistances& body, double eye_m,
                    const Light& handle_colour, StonePixels& pixels) {
  if (pixels.count() == 0) return;
  const Outline outline(handle, body, pixels);
  const Eigen::Array3f colour = handle_colour.cast<float>().array();
  for (Eigen::Index i = 0; i < pixels.count(); ++i) {
    if (!(pixels.usable[i] > 0.0F) || !outline.on_far_rim(i) || outline.inside_px(i) > reach_px) continue;
    const Rim rim = outline.rim(i);
    const float far_px = grip_px(pixels.sights, i, eye_m);
    if (grip_over(source, rim.at, rim.outward, far_px, colour, pixels.behind.row(i).transpose())) {
      pixels.usable[i] = 0.0F;
    }
  }
}

}  // namespace hogline::vision
