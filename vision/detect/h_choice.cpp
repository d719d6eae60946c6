#include "vision/detect/h_choice.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::vision {
namespace {

constexpr double tilt_sigma_rad = 0.004;    // the body rocks by tenths of a degree against the mount
constexpr double missing_sideline_m = 0.5;  // costs as much as so wide a gap
constexpr double missing_centre_m = 0.5;
constexpr double hidden_hog_m = 1.5;  // times the share of it that was not seen
constexpr double largest_x_m = 1.3;   // of a running thrower from the centre line
constexpr double largest_term_m = 1.0;

/// A down-ice line where it meets a hog line: metres to the right of b's origin along the hog line.
struct Intercept {
  const ClassifiedLine* line;
  double x_m;
  double gap_m;
};

// The tilt turns a line seen from the side: far lines to the left and right lean towards each other or apart.
double slope_tolerance(const HKnowledge& known, double intercept_m) {
  return 0.012 + 3.0 * tilt_sigma_rad / known.camera_height_m * std::abs(intercept_m);
}

// Where the line crosses the hog line, along the hog line. Both are known in b's ground coordinates.
double intercept_on(const CrossCandidate& hog, const ClassifiedLine& line) {
  // Directions: hog line (cos yaw, -sin yaw); down-ice line at slope a: (-sin a, cos a), normal (cos a, sin a).
  const Eigen::Vector2d normal(std::cos(line.slope_rad), std::sin(line.slope_rad));
  const Eigen::Vector2d along(std::cos(hog.yaw_rad), -std::sin(hog.yaw_rad));
  return (line.intercept_m - hog.distance_m * normal.dot(hog.normal())) / normal.dot(along);
}

double end_gap(const CrossCandidate& hog, double x_m) {
  const double lo = hog.begin_x_m / std::cos(hog.yaw_rad);
  const double hi = hog.end_x_m / std::cos(hog.yaw_rad);
  return std::max({0.0, x_m - hi, lo - x_m});
}

std::vector<Intercept> intercepts(const CrossCandidate& hog, const std::vector<ClassifiedLine>& down_ice,
                                  const HKnowledge& known) {
  std::vector<Intercept> found;
  for (const ClassifiedLine& line : down_ice) {
    if (std::abs(line.slope_rad + hog.yaw_rad) > slope_tolerance(known, line.intercept_m)) continue;
    const double x = intercept_on(hog, line);
    found.push_back({&line, x, std::min(end_gap(hog, x), largest_term_m)});
  }
  return found;
}

/// One combination: any of the three may be missing.
struct Trio {
  const Intercept* left;
  const Intercept* right;
  const Intercept* centre;
};

class Judge {
 public:
  Judge(const CrossCandidate& hog, const HKnowledge& known) : hog_(hog), known_(known) {
    // A tilt error scales the ice far ahead.
    scale_sigma_ = tilt_sigma_rad * hog.distance_m / known.camera_height_m;
  }

  std::optional<HShape> weigh(const Trio& trio) const {
    HShape h;
    h.hog = hog_;
    h.error_m = hidden_hog_m * (1.0 - std::min(1.0, hog_.visible));
    double x = 0.0;
    if (trio.left != nullptr && trio.right != nullptr) {
      const double spacing = trio.right->x_m - trio.left->x_m;
      const double sigma = std::hypot(known_.width_sigma_m, scale_sigma_ * known_.width_m);
      if (spacing < rules::min_width_m * (1.0 - 3.0 * scale_sigma_) - 0.05 ||
          spacing > rules::max_width_m * (1.0 + 3.0 * scale_sigma_) + 0.05)
        return std::nullopt;
      h.error_m += std::min(largest_term_m, 0.3 / sigma * std::abs(spacing - known_.width_m));
      h.width_m = std::clamp(spacing, rules::min_width_m, rules::max_width_m);
      x = -0.5 * (trio.left->x_m + trio.right->x_m);
    } else if (trio.left != nullptr || trio.right != nullptr) {
      x = trio.left != nullptr ? -(trio.left->x_m + 0.5 * known_.width_m) : -(trio.right->x_m - 0.5 * known_.width_m);
    }
    for (const Intercept* side : {trio.left, trio.right})
      h.error_m += side != nullptr ? side->gap_m : missing_sideline_m;
    if (trio.centre != nullptr) {
      const double to_sides = std::abs(-trio.centre->x_m - x);
      const bool sides = trio.left != nullptr || trio.right != nullptr;
      const double tolerance = (h.width_m ? 0.06 : 0.4) + 0.5 * scale_sigma_;
      if (sides && to_sides > tolerance) return std::nullopt;
      x = -trio.centre->x_m;
      if (sides && !h.width_m) {
        const double half =
            trio.left != nullptr ? trio.centre->x_m - trio.left->x_m : trio.right->x_m - trio.centre->x_m;
        h.width_m = std::clamp(2.0 * half, rules::min_width_m, rules::max_width_m);
      }
      // A centre line is seen from near to far; more of it is better.
      h.error_m += missing_centre_m / (1.0 + trio.centre->line->line.votes / 100.0);
    } else {
      h.error_m += missing_centre_m;
      if (trio.left == nullptr && trio.right == nullptr) return std::nullopt;
    }
    if (std::abs(x) > largest_x_m) return std::nullopt;
    set_body(h, x);
    if (!expected(h.body)) return std::nullopt;
    if (trio.left != nullptr) h.left = *trio.left->line;
    if (trio.right != nullptr) h.right = *trio.right->line;
    if (trio.centre != nullptr) h.centre = *trio.centre->line;
    return h;
  }

 private:
  void set_body(HShape& h, double x) const {
    h.body.yaw_rad = hog_.yaw_rad;
    h.body.x_m = x;
    h.body.y_m = rules::tee_to_hog_m + 0.5 * rules::hog_line_width_m - hog_.distance_m;
  }

  bool expected(const PlanarPose& body) const {
    if (!known_.body) return true;
    const double far_m = std::max(0.0, hog_.distance_m);
    const double y_slack_m = 4.0 * known_.body_sigma.y_m + 3.0 * scale_sigma_ * far_m + 0.05;
    return std::abs(body.x_m - known_.body->x_m) < 4.0 * known_.body_sigma.x_m + 3.0 * scale_sigma_ + 0.1 &&
           std::abs(body.y_m - known_.body->y_m) < y_slack_m &&
           std::abs(body.yaw_rad - known_.body->yaw_rad) < 4.0 * known_.body_sigma.yaw_rad + 0.02;
  }

  const CrossCandidate& hog_;
  const HKnowledge& known_;
  double scale_sigma_;
};

void try_all(const CrossCandidate& hog, const std::vector<Intercept>& lines, const HKnowledge& known,
             std::vector<HShape>& found) {
  const Judge judge(hog, known);
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
        const auto h = judge.weigh({l, r, c});
        if (h && (!best || h->error_m < best->error_m)) best = h;
      }
    }
  }
  if (best) found.push_back(*best);
}

}  // namespace

std::vector<HShape> choose_h(const std::vector<CrossCandidate>& hog_lines, const std::vector<ClassifiedLine>& down_ice,
                             const HKnowledge& known) {
  std::vector<HShape> found;
  for (const CrossCandidate& hog : hog_lines) try_all(hog, intercepts(hog, down_ice, known), known, found);
  std::sort(found.begin(), found.end(), [](const HShape& a, const HShape& b) { return a.error_m < b.error_m; });
  return found;
}

}  // namespace hogline::vision
