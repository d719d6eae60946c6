#include "tests/bench/comparison.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "tests/bench/processor_time.hpp"

namespace hogline::bench {
namespace {

constexpr double start_off_m = 0.01;
constexpr double start_off_rad = 0.1 * std::numbers::pi / 180.0;

vision::Pose near_truth(const Shot& shot, const vision::CameraSetup& setup) {
  PlanarPose start = shot.body;
  start.x_m += start_off_m;
  start.y_m += start_off_m;
  start.yaw_rad += start_off_rad;
  return vision::eMb(start) * vision::bMc(setup.mount);
}

bool wild(const PlanarPose& error) {
  return !(std::hypot(error.x_m, error.y_m) < wild_m) || !(std::abs(error.yaw_rad) < wild_rad);
}

Outcome outcome_of(Method& method, const Shot& shot) {
  Outcome outcome;
  const double begin_s = processor_time_s();
  const Look look = method.look(shot.frame);
  outcome.time_s = processor_time_s() - begin_s;
  outcome.undistort_s = look.undistort_s;
  outcome.reason = look.reason;
  if (!look.ok) return outcome;
  outcome.error = {look.body.x_m - shot.body.x_m, look.body.y_m - shot.body.y_m,
                   vision::wrapped(look.body.yaw_rad - shot.body.yaw_rad)};
  outcome.seen = !wild(outcome.error);
  if (!outcome.seen) outcome.reason = "wild";
  return outcome;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const double at = share * static_cast<double>(values.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), values.size() - 1);
  const auto j = std::min(i + 1, values.size() - 1);
  return values[i] + (at - static_cast<double>(i)) * (values[j] - values[i]);
}

}  // namespace

std::vector<Column> compare(const std::vector<Contestant>& contestants, const std::vector<Footage>& footage) {
  std::vector<Column> columns;
  for (const Contestant& contestant : contestants) columns.push_back({contestant, {}});
  for (const Footage& run : footage) {
    std::vector<std::unique_ptr<Method>> methods;
    for (const Contestant& contestant : contestants) methods.push_back(contestant.make(run));
    std::vector<bool> running(methods.size(), false);
    for (int k = 0; k < run.frames; ++k) {
      const Shot shot = run.shot(k);
      for (std::size_t m = 0; m < methods.size(); ++m) {
        if (contestants[m].tracks && !running[m]) methods[m]->start(shot.frame, near_truth(shot, run.setup));
        Outcome outcome = outcome_of(*methods[m], shot);
        running[m] = outcome.seen;
        outcome.footage = run.name;
        if (k >= run.first_counted) columns[m].outcomes.push_back(std::move(outcome));
      }
    }
  }
  return columns;
}

void keep_shorter_times(std::vector<Column>& kept, const std::vector<Column>& again) {
  assert(kept.size() == again.size());
  for (std::size_t m = 0; m < kept.size(); ++m) {
    assert(kept[m].outcomes.size() == again[m].outcomes.size());
    for (std::size_t i = 0; i < kept[m].outcomes.size(); ++i) {
      Outcome& a = kept[m].outcomes[i];
      const Outcome& b = again[m].outcomes[i];
      if (b.time_s >= a.time_s) continue;
      a.time_s = b.time_s;
      a.undistort_s = b.undistort_s;
    }
  }
}

Summary summary_of(const Column& column) {
  Summary s;
  std::vector<double> times;
  std::vector<double> rest;
  int seen = 0;
  for (const Outcome& o : column.outcomes) {
    times.push_back(o.time_s);
    rest.push_back(o.time_s - o.undistort_s);
    if (!o.seen) continue;
    ++seen;
    s.yaw_rms_rad += o.error.yaw_rad * o.error.yaw_rad;
    s.x_rms_m += o.error.x_m * o.error.x_m;
    s.y_rms_m += o.error.y_m * o.error.y_m;
    s.yaw_worst_rad = std::max(s.yaw_worst_rad, std::abs(o.error.yaw_rad));
  }
  s.frames = static_cast<int>(column.outcomes.size());
  s.lost = s.frames - seen;
  s.median_s = quantile(times, 0.5);
  s.p95_s = quantile(times, 0.95);
  s.median_without_undistortion_s = quantile(rest, 0.5);
  if (seen > 0) {
    s.yaw_rms_rad = std::sqrt(s.yaw_rms_rad / seen);
    s.x_rms_m = std::sqrt(s.x_rms_m / seen);
    s.y_rms_m = std::sqrt(s.y_rms_m / seen);
  }
  return s;
}

}  // namespace hogline::bench
