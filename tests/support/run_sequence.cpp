#include "tests/support/run_sequence.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <random>

namespace hogline::testing {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

vision::CameraSetup setup_of(const RunMove& move) {
  vision::CameraSetup setup;  // the low camera of config/rigs/practice.yaml
  setup.intrinsics = {1600,  1200,  vision::LensModel::brown_conrady,    700.0, 700.0,
                      795.7, 604.1, {-0.11, 0.011, -0.0002, 0.0003, 0.0}};
  setup.mount = {0.45, 0.0, 0.5, 0.0, 20.0 * degree, 0.0};
  setup.gamma = move.sensor.gamma;
  setup.ice = move.ice;
  setup.sheet.sideline = move.known_sideline;
  return setup;
}

struct Palette {
  hw::sim::Colour outer;
  hw::sim::Colour inner;
  hw::sim::Colour hog_line;
  hw::sim::Colour thin_lines;
};

constexpr std::array<Palette, 4> palettes{{
    {{0.02F, 0.07F, 0.45F}, {0.55F, 0.02F, 0.02F}, {0.50F, 0.02F, 0.02F}, {0.02F, 0.02F, 0.05F}},
    {{0.55F, 0.02F, 0.02F}, {0.02F, 0.07F, 0.45F}, {0.03F, 0.08F, 0.45F}, {0.02F, 0.02F, 0.03F}},
    {{0.02F, 0.25F, 0.06F}, {0.60F, 0.45F, 0.03F}, {0.02F, 0.02F, 0.03F}, {0.03F, 0.08F, 0.45F}},
    {{0.35F, 0.02F, 0.20F}, {0.12F, 0.30F, 0.60F}, {0.02F, 0.25F, 0.06F}, {0.50F, 0.02F, 0.02F}},
}};

}  // namespace

RunMove random_run(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto any = [&random](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  RunMove move;
  move.seed = seed;
  move.speed_mps = any(1.8, 3.2);
  move.acceleration_mps2 = seed % 2 == 0 ? any(0.2, 0.9) : 0.0;
  move.x_m = any(-0.4, 0.4);
  move.yaw_rad = any(-0.04, 0.04);
  move.yaw_rate_radps = any(-0.03, 0.03);
  move.rock_hz = any(2.0, 4.0);
  move.ice.paint_depth_m = any(0.003, 0.012);
  hw::sim::SheetAppearance& sheet = move.rink.sheet;
  sheet.width_m = any(4.32, 5.0);
  const Palette& palette = palettes[seed % palettes.size()];
  sheet.rings[0] = palette.outer;
  sheet.rings[2] = palette.inner;
  sheet.hog_line = palette.hog_line;
  sheet.thin_lines = palette.thin_lines;
  constexpr std::array<hw::sim::Divider, 4> dividers{hw::sim::Divider::line, hw::sim::Divider::bumper,
                                                     hw::sim::Divider::rope, hw::sim::Divider::none};
  constexpr std::array<vision::SidelineKind, 4> kinds{vision::SidelineKind::line, vision::SidelineKind::bumper,
                                                      vision::SidelineKind::unknown, vision::SidelineKind::none};
  sheet.divider = dividers[seed / 4 % dividers.size()];
  move.known_sideline = kinds[seed / 4 % kinds.size()];
  sheet.neighbours = seed % 3 != 0;
  sheet.logos.push_back({any(-1.5, 1.5), 6.4 + any(-1.0, 1.0), 1.0, 0.6, {0.12F, 0.30F, 0.60F}});
  move.sensor.gamma = seed % 2 == 0 ? 2.2 : 1.0;
  move.sensor.full_scale_electrons = any(2000.0, 12000.0);
  move.sensor.pebble_contrast = 0.01;
  move.sensor.blur_sigma_px = any(0.45, 1.0);
  move.rink.light.level = any(0.5, 0.9);
  move.rink.light.lamp_gloss = any(0.0, 1.0);
  return move;
}

RunSequence::RunSequence(const RunMove& move, int threads)
    : move_(move),
      setup_(setup_of(move)),
      renderer_(setup_.intrinsics, move.ice, move.rink, move.sensor, move.seed, threads) {
  assert(move.rate_hz > 0.0);
  assert(!move.legs.empty() || (move.speed_mps > 0.0 && move.acceleration_mps2 >= 0.0));
  const double whole_m = move.first_hog_distance_m - move.last_hog_distance_m;
  double whole_s = 0.0;
  for (const RunLeg& leg : move.legs) whole_s += leg.duration_s;
  const auto goes_on = [&](double t_s) { return move.legs.empty() ? motion(t_s).way_m < whole_m : t_s < whole_s; };
  while (goes_on(frames_ / move.rate_hz)) ++frames_;
}

RunSequence::Motion RunSequence::motion(double t_s) const {
  Motion now{0.0, move_.speed_mps, move_.acceleration_mps2};
  const auto go_on = [&now](double dt_s) {
    now.way_m += (now.speed_mps + 0.5 * now.acceleration_mps2 * dt_s) * dt_s;
    now.speed_mps += now.acceleration_mps2 * dt_s;
  };
  if (move_.legs.empty()) go_on(t_s);
  for (const RunLeg& leg : move_.legs) {
    if (t_s < 0.0) break;
    now.acceleration_mps2 = leg.acceleration_mps2;
    go_on(std::min(t_s, leg.duration_s));
    t_s -= leg.duration_s;
  }
  return now;
}

// A body that stands does not rock.
double RunSequence::pitch_rad(double t_s, const Motion& now) const {
  const double rocking = move_.legs.empty() ? 1.0 : std::min(1.0, std::abs(now.speed_mps));
  return rocking * move_.rock_rad * std::sin(2.0 * std::numbers::pi * move_.rock_hz * t_s) -
         move_.squat_rad_per_mps2 * now.acceleration_mps2;
}

RunFrame RunSequence::frame(int k) const {
  assert(k >= 0 && k < frames_);
  const double t = k / move_.rate_hz;
  const Motion now = motion(t);
  const PlanarPose planar{move_.x_m - std::sin(move_.yaw_rad) * now.way_m,
                          vision::rules::tee_to_hog_m - move_.first_hog_distance_m + now.way_m,
                          move_.yaw_rad + move_.yaw_rate_radps * t};
  vision::Pose eMb = vision::eMb(planar);
  eMb.rotate(Eigen::AngleAxisd(pitch_rad(t, now), Eigen::Vector3d::UnitY()));

  hw::sim::Exposure exposure;
  exposure.eMc = eMb * vision::bMc(setup_.mount);
  exposure.velocity.linear = {-std::sin(move_.yaw_rad) * now.speed_mps, now.speed_mps, 0.0};
  exposure.velocity.angular = {0.0, 0.0, move_.yaw_rate_radps};
  exposure.duration_s = move_.exposure_s;
  RunFrame frame;
  renderer_.render(exposure, move_.seed * 1000 + static_cast<std::uint64_t>(k), frame.bgr);
  frame.stamp = Stamp{from_seconds(t)};
  frame.eMc = exposure.eMc;
  frame.body = vision::planar_body(exposure.eMc, setup_.mount);
  frame.hog_distance_m = vision::rules::tee_to_hog_m - frame.body.y_m;
  return frame;
}

}  // namespace hogline::testing
