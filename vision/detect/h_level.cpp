#include "vision/detect/h_level.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "vision/geometry/sheet.hpp"

namespace hogline::vision {
namespace {

constexpr double lean_step_rad = 0.0006;
constexpr int lean_steps = 24;  // to either side
constexpr double range_m = 8.0;
constexpr double bin_m = 0.01;
constexpr double first_m = rules::min_width_m / 2.0 - 0.05;
constexpr int bins = static_cast<int>((rules::max_width_m - rules::min_width_m) / 2.0 / bin_m) + 11;
constexpr double parallel_cosine = 0.97;
constexpr int fewest_points = 40;
constexpr std::size_t most_voters = 2500;

/// An edge point that may lie on a sideline or on a ring, in e's axes about the body but not yet moved there.
struct Voter {
  Eigen::Vector2d ground;
  Eigen::Vector2d lighter;  ///< unit, on the ice
  double px_per_m_ahead;
};

struct Score {
  double sideline = 0.0;
  double ring = 0.0;
  double width_m = 0.0;
  double sum() const { return sideline + ring; }
};

class Poll {
 public:
  Poll(const std::vector<EdgePoint>& points, const GroundView& view) : view_(view) {
    const Eigen::Vector3d camera = view.gMc().translation();
    const double fh = view.setup().intrinsics.fy_px * camera.z();
    stride_ = 1 + points.size() / most_voters;
    for (std::size_t i = 0; i < points.size(); i += stride_) {
      const EdgePoint& p = points[i];
      const double ahead = p.ground.y() - camera.y();
      if (ahead < 0.2 || ahead > range_m || std::abs(p.ground.x()) > 4.0) continue;
      voters_.push_back({p.ground, p.ground_normal, fh / (ahead * ahead)});
    }
  }

  Score score(const PlanarPose& body, double lean_rad) {
    std::fill(histogram_.begin(), histogram_.end(), 0.0);
    Score s;
    const double c = std::cos(body.yaw_rad);
    const double n = std::sin(body.yaw_rad);
    const double foot = view_.gMc().translation().y();
    for (const Voter& v : voters_) {
      const Eigen::Vector2d g = leaned(v.ground, lean_rad, view_);
      const Eigen::Vector2d e(body.x_m + c * g.x() - n * g.y(), body.y_m + n * g.x() + c * g.y());
      const Eigen::Vector2d lighter(c * v.lighter.x() - n * v.lighter.y(), n * v.lighter.x() + c * v.lighter.y());
      const double radius = e.norm();
      if (radius < rules::outer_ring_radius_m + 0.2 && std::abs(e.dot(lighter)) > parallel_cosine * radius) {
        s.ring += on_ring(radius, 0.008 + 1.2 / v.px_per_m_ahead);
      }
      if (lighter.x() * e.x() > -0.9 * std::abs(e.x())) continue;  // a sideline's inner edge is lighter inside
      const double ahead = std::max(0.2, g.y() - foot);
      vote(std::abs(e.x()), 0.008 + 1.2 * std::abs(e.x()) / ahead / v.px_per_m_ahead);
    }
    s.sideline = *std::max_element(histogram_.begin(), histogram_.end());
    s.width_m = innermost_width(s.sideline);
    s.sideline *= static_cast<double>(stride_);
    s.ring *= static_cast<double>(stride_);
    return s;
  }

 private:
  // A neighbouring sheet's sidelines lie 0.1 to 0.3 m outside ours and may be seen better.
  double innermost_width(double most) const {
    std::size_t i = 0;
    while (i + 1 < histogram_.size() && histogram_[i] < 0.6 * most) ++i;
    std::size_t peak = i;
    for (std::size_t k = i; k < std::min(i + 8, histogram_.size()); ++k) {
      if (histogram_[k] > histogram_[peak]) peak = k;
    }
    return 2.0 * (first_m + (static_cast<double>(peak) + 0.5) * bin_m);
  }

  static double on_ring(double radius, double tolerance) {
    double best = 0.0;
    for (const double r : {rules::outer_ring_radius_m, rules::middle_ring_radius_m, rules::inner_ring_radius_m}) {
      best = std::max(best, 1.0 - std::abs(radius - r) / tolerance);
    }
    return best;
  }

  void vote(double x, double tolerance) {
    const int begin = std::max(0, static_cast<int>((x - tolerance - first_m) / bin_m));
    const int end = std::min(bins - 1, static_cast<int>((x + tolerance - first_m) / bin_m));
    for (int i = begin; i <= end; ++i) {
      const double off = std::abs(first_m + (i + 0.5) * bin_m - x);
      histogram_[static_cast<std::size_t>(i)] += std::max(0.0, 1.0 - off / tolerance);
    }
  }

  const GroundView& view_;
  std::vector<Voter> voters_;
  std::size_t stride_ = 1;  ///< of the points, one votes for so many
  std::array<double, bins> histogram_{};
};

}  // namespace

Eigen::Vector2d leaned(const Eigen::Vector2d& ground, double lean_rad, const GroundView& view) {
  const Eigen::Vector3d camera = view.gMc().translation();
  const Eigen::Vector2d d = ground - camera.head<2>();
  // To the second order: leans are some milliradians.
  const double s = lean_rad;
  const double c = 1.0 - 0.5 * lean_rad * lean_rad;
  const double down = d.y() * s + camera.z() * c;
  return camera.head<2>() + camera.z() / down * Eigen::Vector2d(d.x(), d.y() * c - camera.z() * s);
}

PlanarPose body_before(const CrossCandidate& hog, double centre_x_m, double lean_rad, const GroundView& view) {
  const Eigen::Vector2d along(std::cos(hog.yaw_rad), -std::sin(hog.yaw_rad));
  const Eigen::Vector2d foot = hog.distance_m * hog.normal();
  const Eigen::Vector2d a = leaned(foot - along, lean_rad, view);
  const Eigen::Vector2d b = leaned(foot + along, lean_rad, view);
  const Eigen::Vector2d direction = (b - a).normalized();
  const Eigen::Vector2d normal(-direction.y(), direction.x());
  const Eigen::Vector2d centre = leaned(foot + centre_x_m * along, lean_rad, view);
  return {.x_m = -direction.dot(centre),
          .y_m = rules::tee_to_hog_m + 0.5 * rules::hog_line_width_m - normal.dot(a),
          .yaw_rad = std::atan2(-direction.y(), direction.x())};
}

std::optional<LeanVote> vote_for_lean(const std::vector<EdgePoint>& points, const CrossCandidate& hog,
                                      double centre_x_m, const GroundView& view) {
  Poll poll(points, view);
  std::array<Score, 2 * lean_steps + 1> scores{};
  for (int i = 0; i < static_cast<int>(scores.size()); ++i) {
    const double lean = (i - lean_steps) * lean_step_rad;
    scores[static_cast<std::size_t>(i)] = poll.score(body_before(hog, centre_x_m, lean, view), lean);
  }
  std::array<double, 2 * lean_steps + 1> votes{};
  for (std::size_t i = 1; i + 1 < scores.size(); ++i) {
    const double lean = (static_cast<double>(i) - lean_steps) * lean_step_rad;
    const double prior = std::exp(-0.125 * lean * lean / (lean_sigma_rad * lean_sigma_rad));
    votes[i] = prior * (scores[i - 1].sum() + 2.0 * scores[i].sum() + scores[i + 1].sum());
  }
  const auto peak = std::max_element(votes.begin(), votes.end());
  const auto best = static_cast<std::size_t>(peak - votes.begin());
  if (scores[best].sum() < fewest_points) return std::nullopt;
  // Counts spread by their root: leans with so few votes less are as good.
  const double peak_share = 1.0 - 1.0 / std::sqrt(scores[best].sum());
  const auto high = std::count_if(votes.begin(), votes.end(), [&](double v) { return v > peak_share * *peak; });
  return LeanVote{.lean_rad = (static_cast<double>(best) - lean_steps) * lean_step_rad,
                  .sigma_rad = lean_step_rad * (0.5 + 0.5 * static_cast<double>(high)),
                  .sideline_points = static_cast<int>(scores[best].sideline),
                  .width_m = scores[best].width_m,
                  .ring_points = static_cast<int>(scores[best].ring)};
}

}  // namespace hogline::vision
