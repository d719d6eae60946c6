#include "src/throwing/oracle_seer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "hw/sim/mixed_bits.hpp"
#include "vision/geometry/sheet.hpp"

namespace hogline {
namespace {

using hw::sim::mixed_bits;
using hw::sim::uniform_of;

constexpr std::uint64_t near_stream = 0x6e656172;
constexpr std::uint64_t low_stream = 0x6c6f77;
constexpr std::uint64_t missing_stream = 0x6d697373;

// Standard normal numbers that belong to a seed and nothing else.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : seed_(mixed_bits(seed)) {}
  double uniform() { return uniform_of(mixed_bits(seed_ + ++count_)); }
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }
  PlanarPose normal_pose() {
    const double x = normal();
    const double y = normal();
    return {x, y, normal()};
  }

 private:
  std::uint64_t seed_;
  std::uint64_t count_ = 0;
};

SightError mix(const SightError& a, const SightError& b, double share) {
  return {std::lerp(a.offset, b.offset, share), std::lerp(a.bias, b.bias, share), std::lerp(a.drift, b.drift, share),
          std::lerp(a.noise, b.noise, share), std::lerp(a.claimed, b.claimed, share)};
}

// Nothing beyond the outer knots.
std::optional<SightKnot> knot_at(const SightQuality& quality, double hog_m) {
  const auto& knots = quality.knots;
  if (hog_m < knots.front().hog_m || hog_m > knots.back().hog_m) return std::nullopt;
  const auto above = std::ranges::lower_bound(knots, hog_m, {}, &SightKnot::hog_m);
  if (above == knots.begin()) return *above;
  const SightKnot& b = *above;
  const SightKnot& a = *std::prev(above);
  const double share = (hog_m - a.hog_m) / (b.hog_m - a.hog_m);
  return SightKnot{.hog_m = hog_m,
                   .missing_share = std::lerp(a.missing_share, b.missing_share, share),
                   .x = mix(a.x, b.x, share),
                   .y = mix(a.y, b.y, share),
                   .yaw = mix(a.yaw, b.yaw, share)};
}

// Frames are missing in runs of this length.
bool missing(std::uint64_t seed, std::uint64_t frame, const SightQuality& quality, double share) {
  const auto run = static_cast<std::uint64_t>(std::max(1.0, std::round(quality.missing_frames)));
  return Draw(seed ^ mixed_bits(missing_stream + frame / run)).uniform() < share;
}

SheetPosePercept unseen(Stamp stamp, const char* reason) {
  SheetPosePercept percept;
  percept.reason = reason;
  percept.stamp = stamp;
  return percept;
}

double error_of(const SightError& e, double bias, double drift, double noise) {
  return e.offset + e.bias * bias + e.drift * drift + e.noise * noise;
}

}  // namespace

OracleSeer::OracleSeer(const hw::sim::WorldHistory& history, double sheet_width_m, const OracleMounts& mounts,
                       OracleQuality quality, std::uint64_t seed)
    : history_(history), sheet_width_m_(sheet_width_m), mounts_(mounts), quality_(std::move(quality)) {
  for (const auto& [eye, stream] : {std::pair(&near_, near_stream), std::pair(&low_, low_stream)}) {
    eye->seed = mixed_bits(seed ^ stream);
    Draw draw(eye->seed);
    eye->bias = draw.normal_pose();
    eye->drift = draw.normal_pose();
  }
}

SheetPosePercept OracleSeer::near_view(const hw::Frame& frame) {
  if (history_.at(frame.stamp).arm_unfolded < 1.0) return unseen(frame.stamp, "the head is folded away");
  return see(frame, quality_.near, mounts_.near, near_);
}

SheetPosePercept OracleSeer::low_view(const hw::Frame& frame, const vision::LowViewPrediction&) {
  return see(frame, quality_.low, mounts_.low, low_);
}

SheetPosePercept OracleSeer::see(const hw::Frame& frame, const SightQuality& quality, const vision::Mount& mount,
                                 Eye& eye) const {
  constexpr double width_sigma_m = 0.001;
  const PlanarPose truth = history_.at(frame.stamp).body;
  const auto knot = knot_at(quality, vision::rules::tee_to_hog_m - truth.y_m);
  if (!knot) return unseen(frame.stamp, "the hog line is out of sight");
  if (missing(eye.seed, frame.id, quality, knot->missing_share)) return unseen(frame.stamp, "too little paint agrees");

  Draw of_frame(eye.seed ^ mixed_bits(frame.id + 1));
  const PlanarPose noise = of_frame.normal_pose();
  const PlanarPose fresh = of_frame.normal_pose();
  const double gap_s = eye.last ? seconds(frame.stamp - *eye.last) : 0.0;
  const double keep = std::exp(-std::max(gap_s, 0.0) / quality.drift_time_s);
  const double renew = std::sqrt(1.0 - keep * keep);
  eye.drift = {keep * eye.drift.x_m + renew * fresh.x_m, keep * eye.drift.y_m + renew * fresh.y_m,
               keep * eye.drift.yaw_rad + renew * fresh.yaw_rad};

  SheetPosePercept percept;
  percept.ok = true;
  percept.stamp = frame.stamp;
  percept.body = {
      truth.x_m + error_of(knot->x, eye.bias.x_m, eye.drift.x_m, noise.x_m),
      truth.y_m + error_of(knot->y, eye.bias.y_m, eye.drift.y_m, noise.y_m),
      vision::wrapped(truth.yaw_rad + error_of(knot->yaw, eye.bias.yaw_rad, eye.drift.yaw_rad, noise.yaw_rad))};
  percept.sigma = {knot->x.claimed, knot->y.claimed, knot->yaw.claimed};
  percept.hog_distance_m = vision::rules::tee_to_hog_m - percept.body.y_m;
  percept.hog_distance_sigma_m = knot->y.claimed;
  percept.sheet_width_m = sheet_width_m_ + width_sigma_m * of_frame.normal();
  percept.eMc = vision::row_major(vision::eMb(percept.body) * vision::bMc(mount));
  percept.features = {"oracle"};
  eye.last = frame.stamp;
  return percept;
}

}  // namespace hogline
