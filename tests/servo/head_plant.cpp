#include "tests/servo/head_plant.hpp"

#include <algorithm>
#include <cmath>

#include "tests/servo/rig.hpp"

namespace hogline::servo::test {

namespace {
constexpr std::size_t dead_periods = 2;  // 10 ms
constexpr double lag_s = 0.03;
constexpr double acceleration_radps2 = 360.0 * degree;
constexpr double encoder_rad = 0.002 * degree;
}  // namespace

HeadGeometry head_geometry(double pitch_rad, double yaw_rad) {
  HeadGeometry head;
  head.pan_axis_m = {0.1, 0.0, 1.9};
  head.tilt_axis_m = {0.02, 0.0, 0.1};
  head.camera_m = {0.08, -0.06, 0.03};
  const double cp = std::cos(pitch_rad), sp = std::sin(pitch_rad), cy = std::cos(yaw_rad), sy = std::sin(yaw_rad);
  // Columns: the camera's right, down and forward axes in h.
  head.hRc = {sy, -cy * sp, cy * cp, -cy, -sy * sp, sy * cp, 0.0, -cp, -sp};
  return head;
}

HeadAimingConfig aiming_config() {
  HeadAimingConfig config;
  config.head = head_geometry();
  config.pan = {-170.0 * degree, 170.0 * degree, 90.0 * degree, 300.0 * degree};
  config.tilt = {-20.0 * degree, 75.0 * degree, 90.0 * degree, 300.0 * degree};
  config.drive_lag_s = 0.04;
  return config;
}

HeadPlant::HeadPlant(const HeadAngles& start, Stamp now) : now_(now), angles_(start) {
  history_.push_back({now, start, 0.0, 0.0});
  on_their_way_.assign(dead_periods, {});
}

void HeadPlant::step(double pan_radps, double tilt_radps) {
  on_their_way_.push_back({pan_radps, tilt_radps});
  const Command command = on_their_way_.front();
  on_their_way_.pop_front();
  const double dt = seconds(head_period);
  const auto follow = [&](double& rate, double wanted) {
    const double change = (wanted - rate) * (1.0 - std::exp(-dt / lag_s));
    rate += std::clamp(change, -acceleration_radps2 * dt, acceleration_radps2 * dt);
  };
  follow(pan_radps_, command.pan_radps);
  follow(tilt_radps_, command.tilt_radps);
  angles_.pan_rad += pan_radps_ * dt;
  angles_.tilt_rad += tilt_radps_ * dt;
  now_ += head_period;
  history_.push_back({now_, angles_, pan_radps_, tilt_radps_});
  if (history_.size() > 400) history_.pop_front();
  const HeadAimingConfig config = aiming_config();
  for (const auto& [angle, limits] :
       {std::pair(angles_.pan_rad, config.pan), std::pair(angles_.tilt_rad, config.tilt)}) {
    room_rad_ = std::min({room_rad_, angle - limits.min_rad, limits.max_rad - angle});
  }
}

HeadAngles HeadPlant::angles_at(Stamp stamp) const {
  const auto at = std::find_if(history_.begin(), history_.end(), [&](const Moment& m) { return m.stamp >= stamp; });
  return at == history_.end() ? angles_ : at->angles;
}

HeadJoints HeadPlant::measured() const {
  const Moment& m = history_.size() > 1 ? history_[history_.size() - 2] : history_.back();
  const auto read = [](double angle) { return encoder_rad * std::round(angle / encoder_rad); };
  return {m.stamp, {read(m.angles.pan_rad), read(m.angles.tilt_rad)}, m.pan_radps, m.tilt_radps};
}

}  // namespace hogline::servo::test
