#include "servo/thrower_estimate.hpp"

#include <cmath>

namespace hogline::servo {
namespace {

// Encoder noise of a wheel that stands.
constexpr double resting_mps = 0.003;
constexpr double resting_radps = 0.01;
// So many looks in a row that do not fit are not bad luck.
constexpr int contradicting_looks = 10;
// A camera's yaw error is that of its mount, its lens and the paint it sees: it lasts. A second of looks at 60 Hz is
// worth one, and the gyro decides in between.
constexpr double yaw_look_counts_as = 1.0 / 60.0;
// So do those of a distance: how the body leans while it speeds up, the ice over the paint, the mount. Looks at paint
// seven metres away claimed 0.6 mm and were 2.7 mm off for seconds (rendered throws, 2026-11-22).
constexpr double distance_look_counts_as = 1.0 / 15.0;
constexpr double common_distance_sigma_m = 0.002;

bool resting(const PlanarTwist& twist) {
  return std::abs(twist.forward_mps) < resting_mps && std::abs(twist.yaw_rate_radps) < resting_radps;
}

}  // namespace

ThrowerEstimate::ThrowerEstimate(const ThrowerConfig& config, Stamp start)
    : config_(config), heading_(config.gyro, start) {}

void ThrowerEstimate::update(const ThrowerObservation& observation, const EstimateUse& use) {
  if (observation.wheels) take_wheels(*observation.wheels, use.standing);
  if (observation.gyro && observation.gyro->valid) take_gyro(*observation.gyro, use.standing);
  if (use.near_view && observation.near_view) take_near_view(*observation.near_view);
  if (use.low_view && observation.low_view) take_low_view(*observation.low_view);
}

void ThrowerEstimate::start_heading(Stamp now, const StandingPlace& place) {
  heading_.start(now, place.body.yaw_rad, place.sigma.yaw_rad);
}

void ThrowerEstimate::start_line(Stamp now, const StandingPlace& place, const ShotOrder& order) {
  ShotLine line{place.body.x_m, place.body.y_m, order.heading_rad};
  if (order.release_x_m) {
    line.x_m = *order.release_x_m;
    line.y_m += place.hog_distance_m - config_.release.hog_distance_m + config_.release.stone_x_m;
  }
  const double lateral_m = line.lateral_m(place.body.x_m, place.body.y_m);
  lateral_.emplace(line, config_.odometry, lateral_m, place.sigma.x_m);
  hog_distance_.emplace(config_.odometry, now, place.hog_distance_m, place.hog_distance_sigma_m);
}

std::optional<std::string> ThrowerEstimate::contradiction() const {
  if (heading_.gated_in_a_row() >= contradicting_looks) return "the sheet's direction and the gyro disagree";
  if (hog_distance_ && hog_distance_->gated_in_a_row() >= contradicting_looks) {
    return "the hog line and the wheels disagree on the distance";
  }
  return std::nullopt;
}

void ThrowerEstimate::take_wheels(const WheelObservation& wheels, bool standing) {
  if (wheels_stamp_ && wheels.stamp <= *wheels_stamp_) return;
  const double dt_s = wheels_stamp_ ? seconds(wheels.stamp - *wheels_stamp_) : 0.0;
  wheels_stamp_ = wheels.stamp;
  odometry_ = twist_of({wheels.left_radps, wheels.right_radps}, config_.base);
  resting_s_ = standing && resting(odometry_) ? resting_s_ + dt_s : 0.0;
  if (!on_line()) return;
  // Drives average over a window: a speed taken for that of its stamp would show as a wrong scale after each ramp.
  const Stamp measured = wheels.stamp - from_seconds(config_.odometry.speed_delay_s);
  const HeadingEstimate heading = heading_.at(measured);
  hog_distance_->odometry(measured, odometry_.forward_mps, heading.yaw_rad, slipping_);
  const double scale = hog_distance_->at(measured).scale;
  lateral_->advance(scale * odometry_.forward_mps, heading.yaw_rad, heading.yaw_sigma_rad, dt_s);
}

void ThrowerEstimate::take_gyro(const GyroObservation& gyro, bool standing) {
  heading_.gyro(gyro.stamp, gyro.rate_radps, standing && resting(odometry_));
}

void ThrowerEstimate::take_near_view(const SheetPosePercept& view) {
  if (near_stamp_ && view.stamp == *near_stamp_) return;
  near_stamp_ = view.stamp;
  if (!view.ok || !heading_.started()) return;
  const double yaw_rad = view.body.yaw_rad - yaw_bias(config_.alignment.near_yaw_bias, view.body.yaw_rad);
  heading_.sheet_yaw(view.stamp, yaw_rad, view.sigma.yaw_rad, yaw_look_counts_as);
}

void ThrowerEstimate::take_low_view(const SheetPosePercept& view) {
  if (low_stamp_ && view.stamp == *low_stamp_) return;
  low_stamp_ = view.stamp;
  if (!view.ok || !on_line()) return;
  last_sight_ = view.stamp;
  heading_.sheet_yaw(view.stamp, view.body.yaw_rad, view.sigma.yaw_rad, yaw_look_counts_as);
  hog_distance_->hog_distance(view.stamp, view.hog_distance_m,
                              std::hypot(view.hog_distance_sigma_m, common_distance_sigma_m), distance_look_counts_as);
  lateral_->correct(view);
}

}  // namespace hogline::servo
