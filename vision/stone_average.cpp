#include "vision/stone_average.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hogline::vision {
namespace {

constexpr double same_stone_m = 0.14;  // half a stone: no two can be nearer
constexpr double outlier_sigmas = 3.0;
constexpr double least_spread_m = 0.001;
constexpr double least_agreement = 0.7;  // length of the mean direction, of doubled angles: 24 degrees of scatter

double median(std::vector<double> v) {
  const auto middle = v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2);
  std::nth_element(v.begin(), middle, v.end());
  return *middle;
}

struct Spread {
  double middle;
  double sigma;
};

template <typename Part>
Spread spread_of(const std::vector<StoneSighting>& seen, const Part& part) {
  std::vector<double> values;
  for (const StoneSighting& s : seen) values.push_back(part(s));
  const double middle = median(values);
  for (double& v : values) v = std::abs(v - middle);
  return {middle, std::max(least_spread_m, 1.4826 * median(values))};
}

Team majority(const std::vector<StoneSighting>& seen) {
  std::array<int, 3> votes{};
  for (const StoneSighting& s : seen) ++votes[static_cast<std::size_t>(s.team)];
  for (const Team team : {Team::first, Team::second}) {
    if (2 * votes[static_cast<std::size_t>(team)] > static_cast<int>(seen.size())) return team;
  }
  return Team::unknown;
}

// Of directions modulo half a turn: twice the angle goes all around. Each counts by its own doubt.
void average_handles(const std::vector<StoneSighting>& seen, StoneSighting& mean) {
  double sine = 0.0;
  double cosine = 0.0;
  double weights = 0.0;
  int measured = 0;
  for (const StoneSighting& s : seen) {
    if (!s.handle_rad) continue;
    const double weight = 1.0 / std::max(1e-8, s.handle_sigma_rad * s.handle_sigma_rad);
    sine += weight * std::sin(2.0 * *s.handle_rad);
    cosine += weight * std::cos(2.0 * *s.handle_rad);
    weights += weight;
    ++measured;
  }
  mean.handle_rad.reset();
  mean.handle_sigma_rad = 0.0;
  if (2 * measured < static_cast<int>(seen.size()) || measured == 0) return;
  if (std::hypot(sine, cosine) < least_agreement * weights) return;
  const double common = StoneAverage::common_share;
  mean.handle_rad = 0.5 * std::atan2(sine, cosine);
  mean.handle_sigma_rad = std::sqrt((common * measured + 1.0 - common) / weights);
}

StoneSighting mean_of(const std::vector<StoneSighting>& seen) {
  const auto x_of = [](const StoneSighting& s) { return s.x_m; };
  const auto y_of = [](const StoneSighting& s) { return s.y_m; };
  const Spread x = spread_of(seen, x_of);
  const Spread y = spread_of(seen, y_of);
  StoneSighting mean = seen.front();
  mean.x_m = mean.y_m = 0.0;
  mean.covariance = {};
  double count = 0.0;
  for (const StoneSighting& s : seen) {
    if (std::abs(s.x_m - x.middle) > outlier_sigmas * x.sigma ||
        std::abs(s.y_m - y.middle) > outlier_sigmas * y.sigma) {
      continue;
    }
    mean.x_m += s.x_m;
    mean.y_m += s.y_m;
    mean.covariance.xx_m2 += s.covariance.xx_m2;
    mean.covariance.xy_m2 += s.covariance.xy_m2;
    mean.covariance.yy_m2 += s.covariance.yy_m2;
    count += 1.0;
  }
  if (count == 0.0) return seen.front();
  mean.x_m /= count;
  mean.y_m /= count;
  const double common = StoneAverage::common_share;
  const double share = (common + (1.0 - common) / count) / count;
  mean.covariance.xx_m2 *= share;
  mean.covariance.xy_m2 *= share;
  mean.covariance.yy_m2 *= share;
  mean.team = majority(seen);
  average_handles(seen, mean);
  return mean;
}

}  // namespace

void StoneAverage::add(const StonesPercept& frame) {
  if (!frame.ok) return;
  ++frames_;
  for (const StoneSighting& s : frame.stones) {
    const auto same = std::find_if(tracks_.begin(), tracks_.end(), [&s](const Track& t) {
      return std::hypot(t.seen.front().x_m - s.x_m, t.seen.front().y_m - s.y_m) < same_stone_m;
    });
    if (same != tracks_.end()) {
      same->seen.push_back(s);
    } else {
      tracks_.push_back({{s}});
    }
  }
}

std::vector<StoneSighting> StoneAverage::stones() const {
  std::vector<StoneSighting> all;
  for (const Track& t : tracks_) {
    if (2 * static_cast<int>(t.seen.size()) >= frames_) all.push_back(mean_of(t.seen));
  }
  return all;
}

}  // namespace hogline::vision
