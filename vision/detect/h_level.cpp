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

// A hog line far off is a pixel high: by how much its distance errs, the rings seem to lie nearer or farther.
constexpr double hog_row_sigma_px = 0.7;
constexpr double shift_bin_m = 0.01;
constexpr int shift_bins = 25;             // to either side
constexpr double least_ring_height = 0.3;  // of the radius: at the rings' sides a shift along y is not seen
constexpr int fewest_ring_points = 15;

/// An edge point that may lie on a sideline or on a ring, in e's axes about the body but not yet moved there.
struct Voter {
  Eigen::Vector2d ground;
  Eigen::Vector2d lighter;  ///< unit, on the ice
  double px_per_m_ahead;
};

struct Score {
  double sideline = 0.0;
  double ring = 0.0;
  double shift_m = 0.0;  ///< along e's y, with which most points lie on rings
  double width_m = 0.0;
  double sum() const { return sideline + ring; }
};

class Poll {
 public:
  Poll(const std::vector<EdgePoint>& points, double hog_distance_m, const GroundView& view) : view_(view) {
    const Eigen::Vector3d camera = view.gMc().translation();
    const double fh = view.setup().intrinsics.fy_px * camera.z();
    const double hog_sigma_m = 0.005 + hog_row_sigma_px * std::pow(hog_distance_m - camera.y(), 2) / fh;
    for (int i = -shift_bins; i <= shift_bins; ++i) {
      const double off = i * shift_bin_m / hog_sigma_m;
      shift_prior_[static_cast<std::size_t>(i + shift_bins)] = std::exp(-0.5 * off * off);
    }
    stride_ = 1 + points.size() / most_voters;
    for (std::size_t i = 0; i < points.size(); i += stride_) {
      const EdgePoint& p = points[i];
      const double ahead = p.ground.y() - camera.y();
      if (ahead < 0.2 || ahead > range_m || std::abs(p.ground.x()) > 4.0) continue;
      voters_.push_back({p.ground, p.ground_normal, fh / (ahead * ahead)});
    }
  }

  Score score(const PlanarPose& body, double lean_rad) {
    histogram_.fill(0.0);
    shifts_.fill(0.0);
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
        vote_on_rings(e, 0.008 + 1.2 / v.px_per_m_ahead);
      }
      if (lighter.x() * e.x() > -0.9 * std::abs(e.x())) continue;  // a sideline's inner edge is lighter inside
      const double ahead = std::max(0.2, g.y() - foot);
      vote(std::abs(e.x()), 0.008 + 1.2 * std::abs(e.x()) / ahead / v.px_per_m_ahead);
    }
    s.sideline = *std::max_element(histogram_.begin(), histogram_.end());
    s.width_m = innermost_width(s.sideline);
    choose_shift(s);
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

  // By which shift along y the point would lie on a ring.
  void vote_on_rings(const Eigen::Vector2d& e, double tolerance) {
    for (const double r : {rules::outer_ring_radius_m, rules::middle_ring_radius_m, rules::inner_ring_radius_m}) {
      const double height2 = r * r - e.x() * e.x();
      if (height2 < least_ring_height * least_ring_height * r * r) continue;
      const double shift = std::copysign(std::sqrt(height2), e.y()) - e.y();
      const int begin = std::max(-shift_bins, static_cast<int>(std::ceil((shift - tolerance) / shift_bin_m)));
      const int end = std::min(shift_bins, static_cast<int>(std::floor((shift + tolerance) / shift_bin_m)));
      for (int i = begin; i <= end; ++i) {
        shifts_[static_cast<std::size_t>(i + shift_bins)] += 1.0 - std::abs(i * shift_bin_m - shift) / tolerance;
      }
    }
  }

  void choose_shift(Score& s) const {
    for (int i = -shift_bins; i <= shift_bins; ++i) {
      const auto k = static_cast<std::size_t>(i + shift_bins);
      const double votes = shifts_[k] * shift_prior_[k];
      if (votes <= s.ring) continue;
      s.ring = votes;
      s.shift_m = i * shift_bin_m;
    }
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
  std::array<double, 2 * shift_bins + 1> shifts_{};       ///< of the rings
  std::array<double, 2 * shift_bins + 1> shift_prior_{};  ///< by how well the hog line's distance is known
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

PlanarPose body_before(const CrossCandidate& hog, const CentreLine& centre, double lean_rad, const GroundView& view) {
  const Eigen::Vector2d along(std::cos(hog.yaw_rad), -std::sin(hog.yaw_rad));
  const Eigen::Vector2d foot = hog.distance_m * hog.normal();
  const Eigen::Vector2d crossing = leaned(foot + centre.x_m * along, lean_rad, view);
  // Far off the hog line is a few rows high and tells little of its direction; the centre line runs for metres.
  Eigen::Vector2d down_ice;
  if (centre.seen) {
    const auto& [near_by, far_off] = *centre.seen;
    down_ice = (leaned(far_off, lean_rad, view) - leaned(near_by, lean_rad, view)).normalized();
  } else {
    const Eigen::Vector2d a = leaned(foot - along, lean_rad, view);
    const Eigen::Vector2d b = leaned(foot + along, lean_rad, view);
    const Eigen::Vector2d across = (b - a).normalized();
    down_ice = {-across.y(), across.x()};
  }
  return {.x_m = -(down_ice.y() * crossing.x() - down_ice.x() * crossing.y()),
          .y_m = rules::tee_to_hog_m + 0.5 * rules::hog_line_width_m - down_ice.dot(crossing),
          .yaw_rad = std::atan2(down_ice.x(), down_ice.y())};
}

std::optional<LeanVote> vote_for_lean(const std::vector<EdgePoint>& points, const CrossCandidate& hog,
                                      const CentreLine& centre, const GroundView& view) {
  Poll poll(points, hog.distance_m, view);
  std::array<Score, 2 * lean_steps + 1> scores{};
  for (int i = 0; i < static_cast<int>(scores.size()); ++i) {
    const double lean = (i - lean_steps) * lean_step_rad;
    scores[static_cast<std::size_t>(i)] = poll.score(body_before(hog, centre, lean, view), lean);
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
                  .ring_points = static_cast<int>(scores[best].ring),
                  .ring_shift_m = scores[best].ring < fewest_ring_points ? 0.0 : scores[best].shift_m};
}

}  // namespace hogline::vision
