#include "vision/detect/line_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hogline::vision {
namespace {

constexpr int angles = 360;  // half a degree a bin
constexpr double rho_step_px = 3.0;
constexpr double rho_limit = 2.5;    // plane units
constexpr int direction_spread = 3;  // bins to either side of the gradient's direction
constexpr int fewest_votes = 25;
constexpr double supporter_px = 3.0;
constexpr double supporter_cosine = 0.9976;  // 4 degrees

class Accumulator {
 public:
  explicit Accumulator(double pixels_per_unit)
      : rho_step_(rho_step_px / pixels_per_unit),
        rhos_(2 * static_cast<int>(rho_limit / rho_step_) + 1),
        votes_(static_cast<std::size_t>(angles) * static_cast<std::size_t>(rhos_), 0) {
    for (int a = 0; a < angles; ++a) {
      const double angle = a * std::numbers::pi / angles;
      directions_.emplace_back(std::cos(angle), std::sin(angle));
    }
  }

  void vote(const EdgePoint& point) {
    const double angle = std::atan2(point.plane_normal.y(), point.plane_normal.x());
    const int centre = static_cast<int>(std::lround(angle / std::numbers::pi * angles));
    for (int d = -direction_spread; d <= direction_spread; ++d) {
      const int a = ((centre + d) % angles + angles) % angles;
      const int r = bin_of(directions_[static_cast<std::size_t>(a)].dot(point.plane));
      if (r >= 0 && r < rhos_) ++at(a, r);
    }
  }

  struct Peak {
    int angle;
    int rho;
    int votes;
  };

  std::vector<Peak> peaks() const {
    std::vector<Peak> found;
    for (int a = 0; a < angles; ++a) {
      for (int r = 2; r < rhos_ - 2; ++r) {
        const int v = smoothed(a, r);
        if (v >= fewest_votes && is_peak(a, r, v)) found.push_back({a, r, v});
      }
    }
    std::sort(found.begin(), found.end(), [](const Peak& x, const Peak& y) { return x.votes > y.votes; });
    return found;
  }

  LineCandidate line(const Peak& peak) const {
    return {.normal = directions_[static_cast<std::size_t>(peak.angle)],
            .rho = (peak.rho - rhos_ / 2) * rho_step_,
            .votes = peak.votes,
            .begin = {},
            .end = {}};
  }

 private:
  int bin_of(double rho) const { return static_cast<int>(std::lround(rho / rho_step_)) + rhos_ / 2; }
  int& at(int a, int r) {
    return votes_[static_cast<std::size_t>(a) * static_cast<std::size_t>(rhos_) + static_cast<std::size_t>(r)];
  }
  int at(int a, int r) const {
    return votes_[static_cast<std::size_t>(a) * static_cast<std::size_t>(rhos_) + static_cast<std::size_t>(r)];
  }
  int smoothed(int a, int r) const { return at(a, r - 1) + at(a, r) + at(a, r + 1); }

  bool is_peak(int a, int r, int v) const {
    for (int da = -2; da <= 2; ++da) {
      // Past 180 degrees the normal turns round and rho changes its sign.
      int na = a + da;
      bool mirrored = false;
      if (na < 0 || na >= angles) {
        na = (na + angles) % angles;
        mirrored = true;
      }
      for (int dr = -2; dr <= 2; ++dr) {
        if (da == 0 && dr == 0) continue;
        const int nr = mirrored ? rhos_ - 1 - (r + dr) : r + dr;
        if (nr < 1 || nr >= rhos_ - 1) continue;
        const int other = smoothed(na, nr);
        if (other > v || (other == v && (da < 0 || (da == 0 && dr < 0)))) return false;
      }
    }
    return true;
  }

  double rho_step_;
  int rhos_;
  std::vector<int> votes_;
  std::vector<Eigen::Vector2d> directions_;
};

bool supports(const EdgePoint& point, const LineCandidate& line, double within) {
  return std::abs(line.normal.dot(point.plane) - line.rho) < within &&
         std::abs(line.normal.dot(point.plane_normal)) > supporter_cosine;
}

// Total least squares over the supporters; twice, the second time from the better line.
bool refine(LineCandidate& line, const std::vector<EdgePoint>& points, double within) {
  std::vector<double> along;
  for (int round = 0; round < 2; ++round) {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
    int count = 0;
    for (const EdgePoint& p : points) {
      if (!supports(p, line, within)) continue;
      mean += p.plane;
      square += p.plane * p.plane.transpose();
      ++count;
    }
    if (count < fewest_votes) return false;
    mean /= count;
    const Eigen::Matrix2d spread = square / count - mean * mean.transpose();
    const double angle = 0.5 * std::atan2(2.0 * spread(0, 1), spread(0, 0) - spread(1, 1));
    line.normal = Eigen::Vector2d(-std::sin(angle), std::cos(angle));
    line.rho = line.normal.dot(mean);
    line.votes = count;
  }
  const Eigen::Vector2d direction(-line.normal.y(), line.normal.x());
  for (const EdgePoint& p : points) {
    if (supports(p, line, within)) along.push_back(direction.dot(p.plane));
  }
  if (along.empty()) return false;
  std::sort(along.begin(), along.end());
  const std::size_t cut = along.size() / 20;
  line.begin = line.rho * line.normal + along[cut] * direction;
  line.end = line.rho * line.normal + along[along.size() - 1 - cut] * direction;
  return true;
}

bool same(const LineCandidate& a, const LineCandidate& b, double within) {
  return std::abs(a.normal.dot(b.normal)) > 0.99998 && std::abs(a.normal.dot(b.begin) - a.rho) < within &&
         std::abs(a.normal.dot(b.end) - a.rho) < within;
}

}  // namespace

std::vector<LineCandidate> find_line_candidates(const std::vector<EdgePoint>& points, double pixels_per_unit,
                                                std::size_t most) {
  Accumulator accumulator(pixels_per_unit);
  for (const EdgePoint& p : points) accumulator.vote(p);

  const double within = supporter_px / pixels_per_unit;
  std::vector<LineCandidate> lines;
  for (const auto& peak : accumulator.peaks()) {
    if (lines.size() >= most) break;
    LineCandidate line = accumulator.line(peak);
    if (!refine(line, points, within)) continue;
    const bool known =
        std::any_of(lines.begin(), lines.end(), [&](const LineCandidate& l) { return same(l, line, within); });
    if (!known) lines.push_back(line);
  }
  return lines;
}

}  // namespace hogline::vision
