#include "vision/detect/h_choice.hpp"

#include <algorithm>
#include <cmath>

#include "vision/detect/h_level.hpp"

namespace hogline::vision {
namespace {

constexpr double slope_sigma_rad = 0.004;  // of a line candidate on the ice
constexpr double hog_row_sigma_px = 0.35;  // one end against the other; far off a row is a tenth of a metre
constexpr double hog_arm_m = 1.5;
constexpr double missing_sideline_m = 0.5;  // costs as much as so wide a gap
constexpr double missing_centre_m = 0.5;
constexpr double hidden_hog_m = 1.5;      // times the share of it that was not seen
constexpr double full_contrast = 0.5;     // paint that takes away half the light is surely paint
constexpr double largest_gap_m = 0.4;     // a logo or a person may hide the rest
constexpr double largest_x_m = 1.07;      // of a running thrower; farther out a sideline could pass for the centre line
constexpr double inner_preference = 0.1;  // of two possible sidelines the inner: the outer one is the neighbour's

/// A straight line on the ice by two of its points.
struct GroundLine {
  Eigen::Vector2d a;
  Eigen::Vector2d b;

  GroundLine leaned_by(double lean_rad, const GroundView& view) const {
    return {leaned(a, lean_rad, view), leaned(b, lean_rad, view)};
  }
  double down_slope() const { return std::atan2(-(b - a).x(), (b - a).y()); }
};

GroundLine ground_line(const ClassifiedLine& line, double begin_m, double end_m) {
  const Eigen::Vector2d normal(std::cos(line.slope_rad), std::sin(line.slope_rad));
  const Eigen::Vector2d along(-normal.y(), normal.x());
  return {line.intercept_m * normal + begin_m * along, line.intercept_m * normal + end_m * along};
}

/// A down-ice line where it meets a hog line: metres to the right of b's origin along the hog line.
struct Intercept {
  const ClassifiedLine* line = nullptr;
  double x_m = 0.0;
  double gap_m = 0.0;
  double slope_by_lean = 0.0;  ///< how its slope turns with the camera's lean
};

/// What may go with one hog line, and what a combination costs.
class Judge {
 public:
  Judge(const CrossCandidate& hog, const HKnowledge& known, const GroundView& view)
      : hog_(hog), known_(known), view_(view), height_m_(view.gMc().translation().z()) {
    // A lean scales the ice far ahead.
    scale_sigma_ = lean_sigma_rad * hog.distance_m / height_m_;
    const double ahead_m = hog.distance_m - view.gMc().translation().y();
    const double m_per_row = ahead_m * ahead_m / (view.setup().intrinsics.fy_px * height_m_);
    hog_yaw_sigma_ = std::hypot(slope_sigma_rad, hog_row_sigma_px * m_per_row / hog_arm_m);
  }

  std::vector<Intercept> intercepts(const std::vector<ClassifiedLine>& down_ice) const {
    std::vector<Intercept> found;
    for (const ClassifiedLine& line : down_ice) {
      // Lines to the left and right lean towards each other or apart with the camera.
      const double tolerance = 3.0 * hog_yaw_sigma_ + 3.0 * lean_sigma_rad / height_m_ * std::abs(line.intercept_m);
      if (std::abs(line.slope_rad + hog_.yaw_rad) > tolerance) continue;
      constexpr double step_rad = 1e-4;
      const GroundLine g = ground_line(line, 1.0, 4.0);
      const double turned = g.leaned_by(step_rad, view_).down_slope() - g.down_slope();
      const double x = intercept(line);
      found.push_back({&line, x, std::min(end_gap(x), largest_gap_m), turned / step_rad});
    }
    return found;
  }

  std::optional<HShape> weigh(const Intercept* left, const Intercept* right, const Intercept* centre) const {
    if (left == nullptr && right == nullptr && centre == nullptr) return std::nullopt;
    HShape h;
    h.hog = hog_;
    h.error_m = hidden_hog_m * (1.0 - std::min(1.0, hog_.visible * std::min(1.0, hog_.contrast / full_contrast)));
    for (const Intercept* side : {left, right}) h.error_m += side != nullptr ? side->gap_m : missing_sideline_m;
    h.error_m += centre != nullptr ? missing_centre_m / (1.0 + centre->line->line.votes / 40.0) : missing_centre_m;
    if (!place_sides(left, right, centre, h)) return std::nullopt;
    if (left != nullptr) h.left = *left->line;
    if (right != nullptr) h.right = *right->line;
    if (centre != nullptr) h.centre = *centre->line;
    level(left, right, centre, h);
    if (std::abs(h.body.x_m) > largest_x_m || !expected(h.body)) return std::nullopt;
    return h;
  }

 private:
  // Where the line crosses the hog line, along the hog line.
  double intercept(const ClassifiedLine& line) const {
    const Eigen::Vector2d normal(std::cos(line.slope_rad), std::sin(line.slope_rad));
    const Eigen::Vector2d along(std::cos(hog_.yaw_rad), -std::sin(hog_.yaw_rad));
    return (line.intercept_m - hog_.distance_m * normal.dot(hog_.normal())) / normal.dot(along);
  }

  // From the hog line's end to the intercept, as far as the picture shows it.
  double end_gap(double x_m) const {
    constexpr double step_m = 0.05;
    const double c = std::cos(hog_.yaw_rad);
    const double end = x_m > 0.0 ? std::max(hog_.end_x_m / c, 0.0) : std::min(hog_.begin_x_m / c, 0.0);
    if (std::abs(end) >= std::abs(x_m)) return 0.0;
    const double sign = x_m > 0.0 ? 1.0 : -1.0;
    double gap = 0.0;
    for (double x = std::abs(end) + 0.5 * step_m; x < std::abs(x_m); x += step_m) {
      const auto pixel = view_.pixel_of_ground(hog_.at(sign * x * c));
      if (pixel && view_.lens().in_picture(*pixel)) gap += step_m;
    }
    return gap;
  }

  // The third term, and x: from the centre line where there is one, else from the sidelines.
  bool place_sides(const Intercept* left, const Intercept* right, const Intercept* centre, HShape& h) const {
    const double nominal_m = known_.width_m.value_or(rules::nominal_width_m);
    if (left != nullptr && right != nullptr) {
      const double spacing = right->x_m - left->x_m;
      const double slack = 0.05 + 3.0 * scale_sigma_ * spacing;
      const double outside = std::max({0.0, rules::min_width_m - spacing, spacing - rules::max_width_m});
      if (outside > slack) return false;
      const double sigma = std::hypot(known_.width_sigma_m, scale_sigma_ * spacing);
      h.error_m += known_.width_m ? 0.3 * std::min(3.0, std::abs(spacing - *known_.width_m) / sigma)
                                  : outside + inner_preference * (spacing - rules::min_width_m);
      h.width_m = std::clamp(spacing, rules::min_width_m, rules::max_width_m);
      h.body.x_m = -0.5 * (left->x_m + right->x_m);
    } else if (left != nullptr) {
      h.body.x_m = -(left->x_m + 0.5 * nominal_m);
    } else if (right != nullptr) {
      h.body.x_m = -(right->x_m - 0.5 * nominal_m);
    }
    if (centre == nullptr) return true;

    const double off = std::abs(centre->x_m + h.body.x_m);
    const bool any_side = left != nullptr || right != nullptr;
    h.body.x_m = -centre->x_m;
    if (!any_side) return true;
    if (off > (h.width_m ? 0.06 : 0.4) + 0.5 * scale_sigma_) return false;
    if (h.width_m) {
      h.error_m += off;
    } else {
      const double half = left != nullptr ? centre->x_m - left->x_m : right->x_m - centre->x_m;
      h.width_m = std::clamp(2.0 * half, rules::min_width_m, rules::max_width_m);
    }
    return true;
  }

  // Parallel lines seen from a camera that leans are not parallel on the ice its mount predicts: yaw and lean by least
  // squares over the slopes, then the body from where the hog line lies with that lean.
  void level(const Intercept* left, const Intercept* right, const Intercept* centre, HShape& h) const {
    const double w = 1.0 / (slope_sigma_rad * slope_sigma_rad);
    const double hog_w = 1.0 / (hog_yaw_sigma_ * hog_yaw_sigma_);
    double a = hog_w, b = 0.0, c = 1.0 / (lean_sigma_rad * lean_sigma_rad), p = hog_w * hog_.yaw_rad, q = 0.0;
    for (const Intercept* i : {left, right, centre}) {
      if (i == nullptr) continue;
      // slope seen + slope_by_lean * lean = -yaw
      a += w;
      b += w * i->slope_by_lean;
      c += w * i->slope_by_lean * i->slope_by_lean;
      p -= w * i->line->slope_rad;
      q -= w * i->slope_by_lean * i->line->slope_rad;
    }
    const double det = a * c - b * b;
    h.lean_rad = (a * q - b * p) / det;
    h.centre_at.x_m = -h.body.x_m;
    if (centre != nullptr) {
      const double near_by_m = view_.gMc().translation().y() + 0.5;
      const GroundLine line = ground_line(*centre->line, near_by_m, near_by_m + 2.5);
      h.centre_at.seen = {line.a, line.b};
    }
    h.body = body_before(hog_, h.centre_at, h.lean_rad, view_);
  }

  bool expected(const PlanarPose& body) const {
    if (!known_.body) return true;
    const double y_slack_m = 4.0 * known_.body_sigma.y_m + 3.0 * scale_sigma_ * hog_.distance_m + 0.05;
    return std::abs(body.x_m - known_.body->x_m) < 4.0 * known_.body_sigma.x_m + 3.0 * scale_sigma_ + 0.1 &&
           std::abs(body.y_m - known_.body->y_m) < y_slack_m &&
           std::abs(body.yaw_rad - known_.body->yaw_rad) < 4.0 * known_.body_sigma.yaw_rad + 0.02;
  }

  const CrossCandidate& hog_;
  const HKnowledge& known_;
  const GroundView& view_;
  double height_m_;
  double scale_sigma_ = 0.0;
  double hog_yaw_sigma_ = 0.0;
};

std::optional<HShape> best_about(const CrossCandidate& hog, const std::vector<ClassifiedLine>& down_ice,
                                 const HKnowledge& known, const GroundView& view) {
  const Judge judge(hog, known, view);
  const std::vector<Intercept> lines = judge.intercepts(down_ice);
  std::vector<const Intercept*> left{nullptr};
  std::vector<const Intercept*> right{nullptr};
  std::vector<const Intercept*> centre{nullptr};
  for (const Intercept& i : lines) {
    if (i.x_m < -(rules::min_width_m / 2.0 - largest_x_m)) left.push_back(&i);
    if (i.x_m > rules::min_width_m / 2.0 - largest_x_m) right.push_back(&i);
    if (std::abs(i.x_m) < largest_x_m) centre.push_back(&i);
  }
  std::optional<HShape> best;
  for (const Intercept* l : left) {
    for (const Intercept* r : right) {
      for (const Intercept* c : centre) {
        const auto h = judge.weigh(l, r, c);
        if (h && (!best || h->error_m < best->error_m)) best = h;
      }
    }
  }
  return best;
}

}  // namespace

std::vector<HShape> choose_h(const std::vector<CrossCandidate>& hog_lines, const std::vector<ClassifiedLine>& down_ice,
                             const HKnowledge& known, const GroundView& view) {
  std::vector<HShape> found;
  for (const CrossCandidate& hog : hog_lines) {
    if (const auto h = best_about(hog, down_ice, known, view)) found.push_back(*h);
  }
  std::sort(found.begin(), found.end(), [](const HShape& a, const HShape& b) { return a.error_m < b.error_m; });
  return found;
}

}  // namespace hogline::vision
