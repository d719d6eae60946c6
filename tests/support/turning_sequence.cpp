#include "tests/support/turning_sequence.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "hw/sim/mixed_bits.hpp"

namespace hogline::testing {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double step_s = 0.001;
constexpr double step_length_m = 0.75;  // of somebody who walks

// The near camera of config/rigs/practice.yaml.
vision::Intrinsics near_lens() {
  return {1600,  1200,  vision::LensModel::brown_conrady,    780.0, 780.0,
          803.2, 596.4, {-0.12, 0.015, 0.0003, -0.0002, 0.0}};
}

vision::CameraSetup setup_of(const TurningMove& move) {
  vision::CameraSetup setup;
  setup.intrinsics = near_lens();
  setup.mount = {0.2, 0.0, 2.0, 0.0, 28.0 * degree, 0.0};
  setup.gamma = move.sensor.gamma;
  setup.ice = move.ice;
  setup.sheet.sideline = vision::SidelineKind::unknown;
  return setup;
}

vision::Pose true_mount(const TurningMove& move) {
  vision::Mount mount = setup_of(move).mount;
  mount.pitch_rad += move.pitch_error_rad;
  return vision::bMc(mount);
}

double normal_of(std::uint64_t seed, std::uint64_t k) {
  const double a = hw::sim::uniform_of(hw::sim::mixed_bits(seed + 2 * k));
  const double b = hw::sim::uniform_of(hw::sim::mixed_bits(seed + 2 * k + 1));
  return std::sqrt(-2.0 * std::log(a)) * std::cos(2.0 * std::numbers::pi * b);
}

hw::sim::PersonLook walking(const Walker& walker, double t_s) {
  hw::sim::PersonLook look = walker.look;
  const double way_m = walker.speed_mps * t_s;
  look.x_m -= way_m * std::sin(look.facing_rad);
  look.y_m += way_m * std::cos(look.facing_rad);
  look.stride_m += 0.5 * step_length_m * std::cos(std::numbers::pi * way_m / step_length_m);
  return look;
}

}  // namespace

TurningMove turning_move(std::uint64_t seed) {
  TurningMove move;
  move.seed = seed;
  move.rink.sheet.width_m = 4.82;
  move.sensor.pebble_contrast = 0.01;
  move.stones.resize(2);
  move.stones[0] = {.x_m = -0.7, .y_m = 0.9, .handle_rad = 0.4};
  move.stones[1] = {.x_m = 0.45, .y_m = -0.8, .handle_rad = -1.1, .plate = {0.75F, 0.60F, 0.02F}};
  return move;
}

TurningMove turning_move_among_people(std::uint64_t seed) {
  TurningMove move = turning_move(seed);
  Walker across;
  across.look = {.x_m = 1.0, .y_m = -0.6, .facing_rad = 90.0 * degree};
  across.speed_mps = 1.5;
  Walker along;
  along.look = {.x_m = -0.9, .y_m = 3.2, .facing_rad = 12.0 * degree, .jacket = {0.03F, 0.05F, 0.30F}};
  move.people = {across, along};
  return move;
}

TurningSequence::TurningSequence(const TurningMove& move, int threads)
    : move_(move),
      setup_(setup_of(move)),
      true_bMc_(true_mount(move)),
      renderer_(setup_.intrinsics, move.ice, move.rink, move.sensor, move.seed, threads) {
  assert(move.rate_hz > 0.0 && move.max_yaw_rate_radps > 0.0 && move.yaw_acceleration_radps2 > 0.0);
  plan();
}

// A trapezoid of the ordered rate, which the drives follow with a first-order lag.
void TurningSequence::plan() {
  const double way = std::abs(move_.turn_rad);
  const double top = std::min(move_.max_yaw_rate_radps, std::sqrt(way * move_.yaw_acceleration_radps2));
  const double ramp_s = top / move_.yaw_acceleration_radps2;
  const double turn_s = way / top + ramp_s;
  const double settled_s = turn_s + 5.0 * move_.drive_lag_s;
  const double end_s = move_.rest_s + settled_s + move_.rest_s;
  Motion now;
  for (double t = 0.0; t <= end_s + step_s; t += step_s) {
    motion_.push_back(now);
    const double in = t - move_.rest_s;
    const double shape = std::clamp(std::min(in, turn_s - in) / ramp_s, 0.0, 1.0);
    const double ordered = std::copysign(top * shape, move_.turn_rad);
    const double before = now.rate_radps;
    now.rate_radps += (ordered - before) * (1.0 - std::exp(-step_s / move_.drive_lag_s));
    now.yaw_rad += 0.5 * (before + now.rate_radps) * step_s;
  }
  frames_ = 1 + static_cast<int>(std::floor(end_s * move_.rate_hz));
}

TurningSequence::Motion TurningSequence::motion_at(double t_s) const {
  const double at = std::clamp(t_s / step_s, 0.0, static_cast<double>(motion_.size() - 1));
  const auto i = std::min(static_cast<std::size_t>(at), motion_.size() - 2);
  const double part = at - static_cast<double>(i);
  const Motion& a = motion_[i];
  const Motion& b = motion_[i + 1];
  return {a.yaw_rad + part * (b.yaw_rad - a.yaw_rad), a.rate_radps + part * (b.rate_radps - a.rate_radps)};
}

vision::Pose TurningSequence::body_at(double t_s) const {
  const Motion motion = motion_at(t_s);
  const PlanarPose planar{move_.start_x_m + move_.slip_m_per_rad * std::abs(motion.yaw_rad), move_.start_y_m,
                          move_.start_yaw_rad + motion.yaw_rad};
  const double rock = move_.rock_rad * motion.rate_radps / move_.max_yaw_rate_radps;
  vision::Pose eMb = vision::eMb(planar);
  eMb.rotate(Eigen::AngleAxisd(rock * std::sin(2.0 * std::numbers::pi * 7.0 * t_s), Eigen::Vector3d::UnitY()) *
             Eigen::AngleAxisd(rock * std::sin(2.0 * std::numbers::pi * 5.0 * t_s), Eigen::Vector3d::UnitX()));
  return eMb;
}

double TurningSequence::gyro_increment(int k) const {
  if (k == 0) return 0.0;
  const double dt_s = 1.0 / move_.rate_hz;
  const double to = time_of(k) - move_.gyro_late_s;
  const double turned = motion_at(to).yaw_rad - motion_at(to - dt_s).yaw_rad;
  const double noise = move_.gyro_noise_rad_per_sqrt_s * std::sqrt(dt_s) *
                       normal_of(hw::sim::mixed_bits(move_.seed ^ 0x6779726fU), static_cast<std::uint64_t>(k));
  return (1.0 + move_.gyro_scale_error) * turned + move_.gyro_bias_radps * dt_s + noise;
}

TurningFrame TurningSequence::truth(int k) const {
  assert(k >= 0 && k < frames_);
  const double t_s = time_of(k);
  TurningFrame frame;
  frame.stamp = Stamp{} + from_seconds(t_s);
  frame.eMc = body_at(t_s) * true_bMc_;
  frame.body = vision::planar_body(frame.eMc, setup_.mount);
  frame.yaw_rate_radps = motion_at(t_s).rate_radps;
  frame.gyro_yaw_increment_rad = gyro_increment(k);
  return frame;
}

TurningFrame TurningSequence::frame(int k) const {
  TurningFrame frame = truth(k);
  const double t_s = time_of(k);
  // The velocity by the difference over the exposure: the blur is that of the pose's own path.
  const double half_s = 0.5 * std::max(move_.exposure_s, step_s);
  const vision::Pose before = body_at(t_s - half_s) * true_bMc_;
  const vision::Pose after = body_at(t_s + half_s) * true_bMc_;
  const Eigen::AngleAxisd turn(after.linear() * before.linear().transpose());
  hw::sim::Exposure exposure;
  exposure.eMc = frame.eMc;
  exposure.velocity.linear = (after.translation() - before.translation()) / (2.0 * half_s);
  exposure.velocity.angular = turn.angle() / (2.0 * half_s) * turn.axis();
  exposure.duration_s = move_.exposure_s;
  exposure.stones = move_.stones;
  for (const Walker& walker : move_.people) exposure.people.push_back(walking(walker, t_s));
  renderer_.render(exposure, hw::sim::mixed_bits(move_.seed ^ hw::sim::mixed_bits(static_cast<std::uint64_t>(k))),
                   frame.bgr);
  return frame;
}

}  // namespace hogline::testing
