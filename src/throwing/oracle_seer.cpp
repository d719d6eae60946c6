#include "src/throwing/oracle_seer.hpp"

#include <cmath>
#include <numbers>

#include "hw/sim/mixed_bits.hpp"
#include "vision/geometry/sheet.hpp"

namespace hogline {
namespace {

using hw::sim::mixed_bits;
using hw::sim::uniform_of;

constexpr double deg = std::numbers::pi / 180.0;
constexpr std::uint64_t near_stream = 0x6e656172;
constexpr std::uint64_t low_stream = 0x6c6f77;

// Standard normal numbers that belong to a seed and nothing else.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : seed_(mixed_bits(seed)) {}
  double uniform() { return uniform_of(mixed_bits(seed_ + ++count_)); }
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }
  PlanarPose normal(const PlanarSigma& sigma) {
    PlanarPose error;
    error.x_m = sigma.x_m * normal();
    error.y_m = sigma.y_m * normal();
    error.yaw_rad = sigma.yaw_rad * normal();
    return error;
  }

 private:
  std::uint64_t seed_;
  std::uint64_t count_ = 0;
};

PlanarPose sum(const PlanarPose& a, const PlanarPose& b) {
  return {a.x_m + b.x_m, a.y_m + b.y_m, vision::wrapped(a.yaw_rad + b.yaw_rad)};
}

SheetPosePercept unseen(Stamp stamp, const char* reason) {
  SheetPosePercept percept;
  percept.reason = reason;
  percept.stamp = stamp;
  return percept;
}

}  // namespace

// Measured on the rendered practice rink (tests/src/throwing/oracle_seer_test.cpp prints the figures).
OracleQuality practice_quality() {
  return {.near = {.noise = {.x_m = 0.00002, .y_m = 0.00005, .yaw_rad = 0.0002 * deg},
                   .bias = {.x_m = 0.00001, .y_m = 0.0003, .yaw_rad = 0.0001 * deg},
                   .claimed = {.x_m = 0.00031, .y_m = 0.00034, .yaw_rad = 0.0009 * deg},
                   .nearest_hog_m = 3.0,
                   .farthest_hog_m = 13.0,
                   .missing_share = 0.0},
          .low = {.noise = {.x_m = 0.00006, .y_m = 0.0025, .yaw_rad = 0.0008 * deg},
                  .bias = {.x_m = 0.00005, .y_m = 0.002, .yaw_rad = 0.0005 * deg},
                  .claimed = {.x_m = 0.0003, .y_m = 0.003, .yaw_rad = 0.0021 * deg},
                  .nearest_hog_m = 0.73,
                  .farthest_hog_m = 10.5,
                  .missing_share = 0.02},
          .width_sigma_m = 0.001};
}

OracleSeer::OracleSeer(const hw::sim::WorldHistory& history, double sheet_width_m, const OracleMounts& mounts,
                       const OracleQuality& quality, std::uint64_t seed)
    : history_(history), sheet_width_m_(sheet_width_m), mounts_(mounts), quality_(quality), seed_(seed) {}

SheetPosePercept OracleSeer::near_view(const hw::Frame& frame) {
  if (history_.at(frame.stamp).arm_unfolded < 1.0) return unseen(frame.stamp, "the head is folded away");
  return see(frame, quality_.near, mounts_.near, mixed_bits(seed_ ^ near_stream));
}

SheetPosePercept OracleSeer::low_view(const hw::Frame& frame, const vision::LowViewPrediction&) {
  return see(frame, quality_.low, mounts_.low, mixed_bits(seed_ ^ low_stream));
}

SheetPosePercept OracleSeer::see(const hw::Frame& frame, const SightQuality& quality, const vision::Mount& mount,
                                 std::uint64_t seed) const {
  const PlanarPose truth = history_.at(frame.stamp).body;
  const double true_hog_m = vision::rules::tee_to_hog_m - truth.y_m;
  if (true_hog_m < quality.nearest_hog_m || true_hog_m > quality.farthest_hog_m) {
    return unseen(frame.stamp, "the hog line is out of sight");
  }
  Draw of_frame(seed ^ mixed_bits(frame.id + 1));
  if (of_frame.uniform() < quality.missing_share) return unseen(frame.stamp, "too little paint agrees");

  SheetPosePercept percept;
  percept.ok = true;
  percept.stamp = frame.stamp;
  percept.body = sum(truth, sum(Draw(seed).normal(quality.bias), of_frame.normal(quality.noise)));
  percept.sigma = quality.claimed;
  percept.hog_distance_m = vision::rules::tee_to_hog_m - percept.body.y_m;
  percept.hog_distance_sigma_m = quality.claimed.y_m;
  percept.sheet_width_m = sheet_width_m_ + quality_.width_sigma_m * of_frame.normal();
  percept.eMc = vision::row_major(vision::eMb(percept.body) * vision::bMc(mount));
  percept.features = {"oracle"};
  return percept;
}

}  // namespace hogline
