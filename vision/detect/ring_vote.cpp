#include "vision/detect/ring_vote.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "vision/geometry/sheet.hpp"

namespace hogline::vision {
namespace {

constexpr double cell_m = 0.06;
constexpr std::array<double, 3> radii_m{rules::outer_ring_radius_m, rules::middle_ring_radius_m,
                                        rules::inner_ring_radius_m};
constexpr int fewest_supporters = 60;
constexpr int most_peaks = 8;
constexpr int last_round = 5;
constexpr std::size_t sectors = 24;
constexpr int fewest_on_arc = 6;
constexpr double near_circle_m = 0.10;
constexpr double aligned_cosine = 0.97;

class Votes {
 public:
  explicit Votes(const StandingRange& range)
      : half_width_m_(range.max_x_m + std::sin(range.max_yaw_rad) * -range.min_y_m),
        nearest_m_(-range.max_y_m - 0.5),
        columns_(static_cast<int>(2.0 * half_width_m_ / cell_m) + 1),
        rows_(static_cast<int>((-range.min_y_m + 0.5 - nearest_m_) / cell_m) + 1),
        cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0.0F) {}

  void add(const Eigen::Vector2d& g) {
    const double c = (g.x() + half_width_m_) / cell_m;
    const double r = (g.y() - nearest_m_) / cell_m;
    if (!(c >= 0.0 && r >= 0.0 && c < columns_ - 1 && r < rows_ - 1)) return;
    const int ci = static_cast<int>(c);
    const int ri = static_cast<int>(r);
    const auto fc = static_cast<float>(c - ci);
    const auto fr = static_cast<float>(r - ri);
    float* cell = cells_.data() + static_cast<std::ptrdiff_t>(ri) * columns_ + ci;
    cell[0] += (1.0F - fc) * (1.0F - fr);
    cell[1] += fc * (1.0F - fr);
    cell[columns_] += (1.0F - fc) * fr;
    cell[columns_ + 1] += fc * fr;
  }

  // The best places, by votes summed over 5 x 5 cells: far edges are blurred by the mount's tilt. A long straight edge
  // votes for strips of places; where they cross they may outdo the house, so more than one place is handed on.
  std::vector<Eigen::Vector2d> peaks(int count) {
    std::vector<Eigen::Vector2d> places;
    sum_up();
    for (int k = 0; k < count; ++k) {
      const auto best = std::max_element(sums_.begin(), sums_.end());
      if (*best <= 0.0F) break;
      const int at = static_cast<int>(best - sums_.begin());
      const int r = at / columns_;
      const int c = at % columns_;
      places.emplace_back(c * cell_m - half_width_m_, r * cell_m + nearest_m_);
      clear_around(r, c);
    }
    return places;
  }

 private:
  void sum_up() {
    sums_.assign(cells_.size(), 0.0F);
    for (int r = 2; r < rows_ - 2; ++r) {
      for (int c = 2; c < columns_ - 2; ++c) {
        float sum = 0.0F;
        for (int dr = -2; dr <= 2; ++dr) {
          const float* row = cells_.data() + static_cast<std::ptrdiff_t>(r + dr) * columns_ + c;
          for (int dc = -2; dc <= 2; ++dc) sum += row[dc];
        }
        sums_[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c)] = sum;
      }
    }
  }

  void clear_around(int row, int column) {
    constexpr int apart = static_cast<int>(0.24 / cell_m);
    for (int r = std::max(row - apart, 0); r <= std::min(row + apart, rows_ - 1); ++r) {
      for (int c = std::max(column - apart, 0); c <= std::min(column + apart, columns_ - 1); ++c) {
        sums_[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c)] = 0.0F;
      }
    }
  }

  double half_width_m_;
  double nearest_m_;
  int columns_;
  int rows_;
  std::vector<float> cells_;
  std::vector<float> sums_;
};

std::size_t sector_of(const Eigen::Vector2d& direction) {
  const double turns = 0.5 + std::atan2(direction.y(), direction.x()) / (2.0 * std::numbers::pi);
  return std::min(static_cast<std::size_t>(turns * sectors), sectors - 1);
}

// Gauss-Newton of the centre on the signed distances to the nearest circle, over aligned points only.
RingVote refine(const std::vector<EdgePoint>& points, Eigen::Vector2d centre) {
  int supporters = 0;
  std::array<int, sectors * radii_m.size()> on_arc{};
  for (int round = 0; round <= last_round; ++round) {
    Eigen::Matrix2d normal = 1e-6 * Eigen::Matrix2d::Identity();
    Eigen::Vector2d rhs = Eigen::Vector2d::Zero();
    supporters = 0;
    const double within = round < 2 ? 2.5 * near_circle_m : near_circle_m;
    for (const EdgePoint& p : points) {
      const Eigen::Vector2d offset = p.ground - centre;
      const double distance = offset.norm();
      if (distance < 0.3 || distance > 2.2) continue;
      const Eigen::Vector2d u = offset / distance;
      if (std::abs(u.dot(p.ground_normal)) < aligned_cosine) continue;
      double nearest = within;
      std::size_t ring = 0;
      for (std::size_t k = 0; k < radii_m.size(); ++k) {
        if (std::abs(distance - radii_m[k]) >= std::abs(nearest)) continue;
        nearest = distance - radii_m[k];
        ring = k;
      }
      if (std::abs(nearest) >= within) continue;
      normal += u * u.transpose();
      rhs += nearest * u;
      ++supporters;
      if (round == last_round) ++on_arc[ring * sectors + sector_of(u)];
    }
    if (supporters < 10) break;
    centre += normal.inverse() * rhs;
  }
  const auto arcs = std::ranges::count_if(on_arc, [](int n) { return n >= fewest_on_arc; });
  return {centre, supporters, static_cast<int>(arcs)};
}

}  // namespace

std::optional<RingVote> vote_for_house(const std::vector<EdgePoint>& points, const StandingRange& range) {
  Votes votes(range);
  for (const EdgePoint& p : points) {
    for (const double radius : radii_m) {
      votes.add(p.ground + radius * p.ground_normal);
      votes.add(p.ground - radius * p.ground_normal);
    }
  }
  std::optional<RingVote> best;
  for (const Eigen::Vector2d& place : votes.peaks(most_peaks)) {
    const RingVote vote = refine(points, place);
    if (vote.supporters < fewest_supporters || !vote.centre.allFinite()) continue;
    if (!best || vote.arcs > best->arcs) best = vote;
  }
  return best;
}

}  // namespace hogline::vision
