#include "src/campaign/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::campaign {
namespace {

// Between the two nearest. Precondition: sorted, not empty.
double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

Statistics statistics_of(std::vector<double> values) {
  Statistics s;
  if (values.empty()) return s;
  std::ranges::sort(values);
  const auto n = static_cast<double>(values.size());
  s.count = static_cast<int>(values.size());
  for (const double v : values) {
    s.mean += v / n;
    s.rms += v * v / n;
    s.largest = std::max(s.largest, std::abs(v));
  }
  for (const double v : values) s.sigma += (v - s.mean) * (v - s.mean);
  s.sigma = values.size() > 1 ? std::sqrt(s.sigma / (n - 1.0)) : 0.0;
  s.rms = std::sqrt(s.rms);
  s.q05 = quantile(values, 0.05);
  s.median = quantile(values, 0.5);
  s.q95 = quantile(values, 0.95);
  return s;
}

}  // namespace hogline::campaign
