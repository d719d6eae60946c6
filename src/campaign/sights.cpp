#include "src/campaign/sights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <iterator>
#include <map>
#include <mutex>
#include <numbers>
#include <thread>

#include "vision/geometry/pose.hpp"
#include "vision/geometry/sheet.hpp"

namespace hogline::campaign {
namespace {

constexpr double not_measured_m = 1.0;  // a claimed sigma beyond this is no measurement
constexpr double held_beyond_m = 1.0;   // how far the outermost figures are trusted
constexpr int least_looks = 40;         // in one stretch of distance
constexpr std::array edges_m{0.6, 0.8, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0};

std::vector<Sighting> watch(const Plan& plan, int number) {
  std::vector<Sighting> seen;
  ThrowRequest request = plan.request(plan.draw(number));
  request.eyes = Eyes::vision;
  request.follow_stone = false;
  request.watch = [&](const Look& look) {
    const SheetPosePercept& p = look.percept;
    Sighting s{.throw_number = number,
               .low = look.low,
               .t_s = seconds(p.stamp.time_since_epoch()),
               .hog_m = vision::rules::tee_to_hog_m - look.truth.y_m,
               .ok = p.ok,
               .error = {},
               .claimed = p.sigma};
    if (p.ok) {
      s.error = {p.body.x_m - look.truth.x_m, p.body.y_m - look.truth.y_m,
                 vision::wrapped(p.body.yaw_rad - look.truth.yaw_rad)};
    }
    seen.push_back(s);
  };
  throw_stone(request, {});
  return seen;
}

// The errors of one coordinate in one stretch of distance, throw by throw.
struct Track {
  std::vector<double> t_s;
  std::vector<double> error;
};
using Tracks = std::map<int, Track>;

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

// Sums of products of errors about their throw's mean, at the same frame, one and two frames later.
struct Autocovariance {
  std::array<double, 3> sum{};
  std::array<double, 3> count{};

  void add(const Track& track) {
    const double mean = mean_of(track.error);
    const std::size_t n = track.error.size();
    for (std::size_t lag = 0; lag < 3; ++lag) {
      for (std::size_t i = 0; i + lag < n; ++i) {
        sum[lag] += (track.error[i] - mean) * (track.error[i + lag] - mean);
        count[lag] += 1.0;
      }
    }
  }
  double at(std::size_t lag) const { return count[lag] > 0.0 ? sum[lag] / count[lag] : 0.0; }
  /// How much of the correlation one frame later is left after another; 0 where there is none.
  double keep() const { return at(1) > 0.0 ? std::clamp(at(2) / at(1), 0.0, 0.98) : 0.0; }
  double drift_variance() const { return keep() > 0.0 ? std::clamp(at(1) / keep(), 0.0, at(0)) : 0.0; }
};

SightError error_of(const Tracks& tracks, const std::vector<double>& claimed, double& keep_sum, double& keep_weight) {
  SightError e;
  std::vector<double> means;
  Autocovariance covariance;
  double looks = 0.0;
  for (const auto& [_, track] : tracks) {
    if (track.error.empty()) continue;
    means.push_back(mean_of(track.error));
    covariance.add(track);
    looks += static_cast<double>(track.error.size());
  }
  std::vector<double> sorted = claimed;
  std::ranges::sort(sorted);
  e.claimed = sorted.empty() ? 0.0 : sorted[sorted.size() / 2];
  if (means.empty()) return e;
  e.offset = mean_of(means);
  double between = 0.0;
  for (const double m : means) between += (m - e.offset) * (m - e.offset);
  if (means.size() > 1) between /= static_cast<double>(means.size() - 1);
  const double per_throw = looks / static_cast<double>(means.size());
  e.bias = std::sqrt(std::max(between - covariance.at(0) / per_throw, 0.0));
  const double drift = covariance.drift_variance();
  e.drift = std::sqrt(drift);
  e.noise = std::sqrt(std::max(covariance.at(0) - drift, 0.0));
  // What drifts most says most of how long drifts last.
  const double weight = covariance.at(0) > 0.0 ? looks * drift / covariance.at(0) : 0.0;
  keep_sum += covariance.keep() * weight;
  keep_weight += weight;
  return e;
}

// What was seen in one stretch of distance.
class Stretch {
 public:
  void add(const Sighting& s) {
    ++looks_;
    hog_m_ += s.hog_m;
    if (!s.ok) return;
    ++seen_;
    note(x_, claimed_x_, s, s.error.x_m, s.claimed.x_m);
    note(yaw_, claimed_yaw_, s, s.error.yaw_rad, s.claimed.yaw_rad);
    claimed_y_.push_back(s.claimed.y_m);
    if (s.claimed.y_m >= not_measured_m) return;
    auto& track = y_[s.throw_number];
    track.t_s.push_back(s.t_s);
    track.error.push_back(s.error.y_m);
  }
  bool tells() const { return seen_ >= least_looks; }
  SightKnot knot(double& keep_sum, double& keep_weight) const {
    SightKnot k;
    k.hog_m = hog_m_ / looks_;
    k.missing_share = 1.0 - static_cast<double>(seen_) / looks_;
    k.x = error_of(x_, claimed_x_, keep_sum, keep_weight);
    k.y = error_of(y_, claimed_y_, keep_sum, keep_weight);
    k.yaw = error_of(yaw_, claimed_yaw_, keep_sum, keep_weight);
    return k;
  }

 private:
  static void note(Tracks& tracks, std::vector<double>& claims, const Sighting& s, double error, double claimed) {
    auto& track = tracks[s.throw_number];
    track.t_s.push_back(s.t_s);
    track.error.push_back(error);
    claims.push_back(claimed);
  }

  int looks_ = 0;
  int seen_ = 0;
  double hog_m_ = 0.0;
  Tracks x_;
  Tracks y_;
  Tracks yaw_;
  std::vector<double> claimed_x_;
  std::vector<double> claimed_y_;
  std::vector<double> claimed_yaw_;
};

// Frames in a row that show nothing, in the mean; between frames that show something.
double run_of_missing(const std::vector<Sighting>& looks) {
  int missing = 0;
  int runs = 0;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    if (looks[i].ok) continue;
    ++missing;
    if (i == 0 || looks[i - 1].ok || looks[i - 1].throw_number != looks[i].throw_number) ++runs;
  }
  return runs > 0 ? static_cast<double>(missing) / runs : 1.0;
}

// The usual time from one look to the next.
double frame_time(const std::vector<Sighting>& looks) {
  std::vector<double> gaps;
  for (std::size_t i = 1; i < looks.size(); ++i) {
    if (looks[i].throw_number == looks[i - 1].throw_number) gaps.push_back(looks[i].t_s - looks[i - 1].t_s);
  }
  if (gaps.empty()) return 1.0 / 60.0;
  std::ranges::nth_element(gaps, gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2));
  return gaps[gaps.size() / 2];
}

// Frames before the first and after the last sight of a throw are out of sight, not missing.
std::vector<Sighting> within_sight(const std::vector<Sighting>& sightings, bool low) {
  std::map<int, std::pair<double, double>> seen;  // throw: first and last time
  for (const Sighting& s : sightings) {
    if (s.low != low || !s.ok) continue;
    const auto [entry, fresh] = seen.try_emplace(s.throw_number, s.t_s, s.t_s);
    if (!fresh) entry->second.second = s.t_s;
  }
  std::vector<Sighting> looks;
  for (const Sighting& s : sightings) {
    const auto span = seen.find(s.throw_number);
    if (s.low != low || span == seen.end()) continue;
    if (s.t_s >= span->second.first && s.t_s <= span->second.second) looks.push_back(s);
  }
  return looks;
}

SightQuality fit_camera(const std::vector<Sighting>& looks) {
  std::map<std::size_t, Stretch> stretches;
  double nearest_m = 1e9;
  double farthest_m = -1e9;
  for (const Sighting& s : looks) {
    const auto edge = std::ranges::upper_bound(edges_m, s.hog_m);
    stretches[static_cast<std::size_t>(edge - edges_m.begin())].add(s);
    nearest_m = std::min(nearest_m, s.hog_m);
    farthest_m = std::max(farthest_m, s.hog_m);
  }
  SightQuality quality;
  double keep_sum = 0.0;
  double keep_weight = 0.0;
  for (const auto& [_, stretch] : stretches) {
    if (stretch.tells()) quality.knots.push_back(stretch.knot(keep_sum, keep_weight));
  }
  const double keep = keep_weight > 0.0 ? keep_sum / keep_weight : 0.0;
  quality.drift_time_s = keep > 0.0 ? -frame_time(looks) / std::log(keep) : frame_time(looks);
  quality.missing_frames = run_of_missing(looks);
  if (!quality.knots.empty()) {
    SightKnot first = quality.knots.front();
    SightKnot last = quality.knots.back();
    first.hog_m = std::min(nearest_m, first.hog_m - held_beyond_m);
    last.hog_m = std::max(farthest_m, last.hog_m + held_beyond_m);
    quality.knots.insert(quality.knots.begin(), first);
    quality.knots.push_back(last);
  }
  return quality;
}

}  // namespace

std::vector<Sighting> watch_throws(const Plan& plan, int throws, int jobs, const std::function<void()>& tick) {
  std::vector<std::vector<Sighting>> each(static_cast<std::size_t>(throws));
  std::atomic<int> next{0};
  std::mutex mutex;
  const auto work = [&] {
    for (int number = next++; number < throws; number = next++) {
      auto seen = watch(plan, number);
      const std::lock_guard lock(mutex);
      each[static_cast<std::size_t>(number)] = std::move(seen);
      if (tick) tick();
    }
  };
  {
    std::vector<std::jthread> crew;
    for (int i = 1; i < jobs; ++i) crew.emplace_back(work);
    work();
  }
  std::vector<Sighting> all;
  for (const auto& seen : each) all.insert(all.end(), seen.begin(), seen.end());
  return all;
}

OracleQuality fit_oracle(const std::vector<Sighting>& sightings) {
  return {.near = fit_camera(within_sight(sightings, false)), .low = fit_camera(within_sight(sightings, true))};
}

std::string sightings_csv(const std::vector<Sighting>& sightings) {
  constexpr double degrees = 180.0 / std::numbers::pi;
  std::string text = "throw,camera,t_s,hog_m,ok,x_error_m,y_error_m,yaw_error_deg,x_sigma_m,y_sigma_m,yaw_sigma_deg\n";
  for (const Sighting& s : sightings) {
    fmt::format_to(std::back_inserter(text), "{},{},{:.6f},{:.6f},{},{:.7f},{:.7f},{:.7f},{:.7f},{:.7f},{:.7f}\n",
                   s.throw_number, s.low ? "low" : "near", s.t_s, s.hog_m, s.ok ? 1 : 0, s.error.x_m, s.error.y_m,
                   s.error.yaw_rad * degrees, s.claimed.x_m, s.claimed.y_m, s.claimed.yaw_rad * degrees);
  }
  return text;
}

}  // namespace hogline::campaign
