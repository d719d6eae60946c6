#include "servo/slip_watch.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::servo {
namespace {

constexpr Duration window = std::chrono::milliseconds(250);
constexpr Duration kept = std::chrono::milliseconds(600);
constexpr std::size_t looks_averaged = 3;  // at either end
constexpr std::size_t least_looks = 2 * looks_averaged;
constexpr double sigmas = 4.0;
constexpr double rolling_share = 0.015;  // of the way: what the odometry's scale may be off by before it is learnt
constexpr double least_slip_mps = 0.04;
constexpr double ends_at_share = 0.5;

}  // namespace

void SlipWatch::wheels(Stamp stamp, double forward_mps) {
  if (!ways_.empty() && stamp <= ways_.back().stamp) return;
  const double step_m = ways_.empty() ? 0.0 : 0.5 * (speed_mps_ + forward_mps) * seconds(stamp - ways_.back().stamp);
  ways_.push_back({stamp, (ways_.empty() ? 0.0 : ways_.back().way_m) + step_m});
  speed_mps_ = forward_mps;
  while (ways_.front().stamp < stamp - kept) ways_.pop_front();
}

std::optional<double> SlipWatch::way_at(Stamp stamp) const {
  const auto after = std::find_if(ways_.begin(), ways_.end(), [&](const Way& w) { return w.stamp >= stamp; });
  if (after == ways_.end() || after == ways_.begin()) return std::nullopt;
  const Way& before = *(after - 1);
  const double part = seconds(stamp - before.stamp) / seconds(after->stamp - before.stamp);
  return before.way_m + part * (after->way_m - before.way_m);
}

void SlipWatch::look(Stamp stamp, double hog_distance_m, double sigma_m) {
  if (!looks_.empty() && stamp <= looks_.back().stamp) return;
  const auto way = way_at(stamp);
  if (!way) return;
  looks_.push_back({stamp, hog_distance_m, sigma_m, *way});
  while (looks_.front().stamp < stamp - window) looks_.pop_front();
  if (looks_.size() >= least_looks) compare();
}

void SlipWatch::compare() {
  double gap_m = 0.0;  // wheels' way less seen way, by the means of the looks at either end
  double variance = 0.0;
  for (std::size_t i = 0; i < looks_averaged; ++i) {
    const Look& first = looks_[i];
    const Look& last = looks_[looks_.size() - 1 - i];
    gap_m += (last.way_m - first.way_m) - (first.hog_distance_m - last.hog_distance_m);
    variance += first.sigma_m * first.sigma_m + last.sigma_m * last.sigma_m;
  }
  constexpr auto count = static_cast<double>(looks_averaged);
  gap_m /= count;
  const double sigma_m = std::sqrt(variance) / count;
  const double span_s = seconds(looks_.back().stamp - looks_.front().stamp);
  const double way_m = std::abs(looks_.back().way_m - looks_.front().way_m);
  const double limit_m = std::max(sigmas * sigma_m + rolling_share * way_m, least_slip_mps * span_s);
  slip_mps_ = span_s > 0.0 ? gap_m / span_s : 0.0;
  slipping_ = std::abs(gap_m) > (slipping_ ? ends_at_share * limit_m : limit_m);
  ever_ = ever_ || slipping_;
}

}  // namespace hogline::servo
