#include "vision/low_sequence.hpp"

#include <cmath>

#include "vision/geometry/sheet_camera.hpp"

namespace hogline::vision {
namespace {

constexpr std::size_t most_looks = 12;
constexpr double largest_span_s = 0.3;
constexpr double acceleration_sigma_mps2 = 0.5;  // of a run: 0.77 m/s2 at most
constexpr double unknown_speed_mps = 3.5;        // the fastest run
constexpr double yaw_acceleration_sigma_radps2 = 0.2;

/// Weighted straight line through (t, value): value and rate at t = 0.
class Line {
 public:
  void add(double t, double value, double sigma) {
    const double w = 1.0 / (sigma * sigma);
    w_ += w;
    wt_ += w * t;
    wtt_ += w * t * t;
    wv_ += w * value;
    wtv_ += w * t * value;
  }
  double value() const { return (wtt_ * wv_ - wt_ * wtv_) / determinant(); }
  double rate() const { return (w_ * wtv_ - wt_ * wv_) / determinant(); }
  double value_sigma() const { return std::sqrt(wtt_ / determinant()); }
  double rate_sigma() const { return std::sqrt(w_ / determinant()); }

 private:
  double determinant() const { return w_ * wtt_ - wt_ * wt_; }
  double w_ = 0.0, wt_ = 0.0, wtt_ = 0.0, wv_ = 0.0, wtv_ = 0.0;
};

PlanarPose carried(const SteadyMotion& m, double dt_s) {
  return {m.at.x_m + m.x_mps * dt_s, m.at.y_m + m.y_mps * dt_s, wrapped(m.at.yaw_rad + m.yaw_radps * dt_s)};
}

PlanarSigma carried_sigma(const SteadyMotion& m, double dt_s) {
  const double drift_m = 0.5 * acceleration_sigma_mps2 * dt_s * dt_s;
  const double turn_rad = 0.5 * yaw_acceleration_sigma_radps2 * dt_s * dt_s;
  return {std::hypot(m.at_sigma.x_m, m.speed_sigma_mps * dt_s, drift_m),
          std::hypot(m.at_sigma.y_m, m.speed_sigma_mps * dt_s, drift_m),
          std::hypot(m.at_sigma.yaw_rad, m.yaw_rate_sigma_radps * dt_s, turn_rad)};
}

}  // namespace

SheetPosePercept LowSequence::step(const cv::Mat& image, Stamp stamp, LowViewSketch* sketch) {
  if (last_stamp_ && stamp <= *last_stamp_) {
    SheetPosePercept refused;
    refused.stamp = stamp;
    refused.reason = "the frame is not newer than the one before";
    return refused;
  }
  last_stamp_ = stamp;
  while (!seen_.empty() && seconds(stamp - seen_.back().stamp) > longest_blind_s) seen_.clear();

  SheetPosePercept percept = view_.acquire(image, stamp, predict(stamp), sketch);
  if (percept.ok) {
    if (percept.sheet_width_m) width_m_ = percept.sheet_width_m;
    seen_.push_back({stamp, percept});
    while (seen_.size() > most_looks || seconds(stamp - seen_.front().stamp) > largest_span_s) seen_.pop_front();
    return percept;
  }
  if (const auto carried_on = dead_reckoned(stamp)) return *carried_on;
  return percept;
}

LowViewPrediction LowSequence::predict(Stamp stamp) const {
  LowViewPrediction prediction;
  prediction.sheet_width_m = width_m_;
  if (seen_.empty()) return prediction;
  const double dt_s = seconds(stamp - seen_.back().stamp);
  if (const auto m = motion()) {
    prediction.body = carried(*m, dt_s);
    prediction.body_sigma = carried_sigma(*m, dt_s);
    return prediction;
  }
  const SheetPosePercept& last = seen_.back().percept;
  prediction.body = last.body;
  prediction.body->y_m += 0.5 * unknown_speed_mps * dt_s;
  prediction.body_sigma = {last.sigma.x_m + 0.1 * unknown_speed_mps * dt_s,
                           last.sigma.y_m + 0.5 * unknown_speed_mps * dt_s, last.sigma.yaw_rad + 0.5 * dt_s};
  return prediction;
}

std::optional<SteadyMotion> LowSequence::motion() const {
  if (seen_.size() < 3) return std::nullopt;
  Line x;
  Line y;
  Line yaw;
  const Stamp now = seen_.back().stamp;
  for (const Look& look : seen_) {
    const double t = seconds(look.stamp - now);
    // A constant acceleration bends the path: older frames say less of the speed now.
    const double bend_m = 0.5 * acceleration_sigma_mps2 * t * t;
    x.add(t, look.percept.body.x_m, std::hypot(look.percept.sigma.x_m, bend_m));
    y.add(t, look.percept.body.y_m, std::hypot(look.percept.sigma.y_m, bend_m));
    yaw.add(t, look.percept.body.yaw_rad,
            std::hypot(look.percept.sigma.yaw_rad, 0.5 * yaw_acceleration_sigma_radps2 * t * t));
  }
  return SteadyMotion{.at = {x.value(), y.value(), yaw.value()},
                      .at_sigma = {x.value_sigma(), y.value_sigma(), yaw.value_sigma()},
                      .x_mps = x.rate(),
                      .y_mps = y.rate(),
                      .yaw_radps = yaw.rate(),
                      .speed_sigma_mps = y.rate_sigma(),
                      .yaw_rate_sigma_radps = yaw.rate_sigma()};
}

// Only where the line is expected below the picture: a line that should be in view and is not was not seen.
std::optional<SheetPosePercept> LowSequence::dead_reckoned(Stamp stamp) const {
  const auto m = motion();
  if (!m) return std::nullopt;
  const double dt_s = seconds(stamp - seen_.back().stamp);
  const PlanarPose body = carried(*m, dt_s);
  if (!hog_line_below(body)) return std::nullopt;
  const PlanarSigma sigma = carried_sigma(*m, dt_s);
  SheetPosePercept p;
  p.ok = true;
  p.stamp = stamp;
  p.body = body;
  p.sigma = sigma;
  p.hog_distance_m = rules::tee_to_hog_m - body.y_m;
  p.hog_distance_sigma_m = sigma.y_m;
  p.sheet_width_m = width_m_;
  p.eMc = row_major(eMb(body) * bMc(setup_.mount));
  p.features = {"dead_reckoning"};
  return p;
}

bool LowSequence::hog_line_below(const PlanarPose& body) const {
  const SheetCamera camera(Lens(setup_.intrinsics), eMb(body) * bMc(setup_.mount), setup_.ice);
  const double half_px = 0.1 * setup_.intrinsics.width_px;
  const double middle_m = camera.eMc().translation().x();
  const auto near_edge = camera.project_paint({middle_m, rules::tee_to_hog_m});
  if (!near_edge) return true;
  return near_edge->y() > setup_.intrinsics.height_px - 1.0 - half_px * 0.25;
}

}  // namespace hogline::vision
