#include "hw/sim/world.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "hw/sim/stone_motion.hpp"

namespace hogline::hw::sim {

namespace {

constexpr Duration longest_step = std::chrono::milliseconds(1);
constexpr double standing_mps = 0.005;
constexpr double tee_to_hog_m = 6.401;  // to the hog line's house-side edge (World Curling)

}  // namespace

World::World(const Scenario& scenario, Stamp start)
    : stone_(scenario.stone), robot_(scenario.robot, scenario.seed * 4 + 1) {
  std::mt19937_64 random(scenario.seed * 4 + 2);
  stone_.friction_scale *= 1.0 + stone_.throw_friction_sigma * std::normal_distribution<double>()(random);
  for (const auto& [x_m, y_m] : stone_.others) {
    truth_.other_teams.push_back(truth_.others.size() % 2 == 0 ? 1 : 0);  // the teams throw by turns
    truth_.others.push_back({.x_m = x_m, .y_m = y_m});
  }
  truth_.stamp = start;
  truth_.held = scenario.gripper.holds_stone_at_start;
  truth_.arm_unfolded = scenario.arm.unfolded_at_start ? 1.0 : 0.0;
  truth_.body = robot_.pose();
  if (truth_.held) carry(0.0);
}

void World::step(const WorldInputs& inputs, Stamp until) {
  truth_.arm_unfolded = inputs.arm_unfolded;
  grip_again(inputs);
  while (truth_.stamp < until) {
    Stamp end = std::min(truth_.stamp + longest_step, until);
    if (truth_.held && inputs.stone_free_at) {
      if (*inputs.stone_free_at <= truth_.stamp) release();
      if (truth_.held) end = std::min(end, *inputs.stone_free_at);
    }
    substep(inputs, end - truth_.stamp);
  }
  if (truth_.held && inputs.stone_free_at && *inputs.stone_free_at <= truth_.stamp) release();
}

void World::substep(const WorldInputs& inputs, Duration span) {
  const double dt_s = seconds(span);
  robot_.step(inputs.axes, truth_.held ? stone_.mass_kg : 0.0, stone_.stone_x_m, dt_s);
  truth_.stamp += span;
  truth_.body = robot_.pose();
  truth_.twist = robot_.twist();
  truth_.acceleration_mps2 = robot_.acceleration_mps2();
  truth_.pitch_rad = robot_.pitch_rad();
  truth_.left_wheel_radps = robot_.left_radps();
  truth_.right_wheel_radps = robot_.right_radps();
  truth_.slipping = robot_.slipping();
  if (truth_.held) {
    carry(inputs.belt_radps);
    truth_.stone.handle_rad += truth_.stone.spin_radps * dt_s;
  } else {
    if (!slides_elsewhere_) slide_stones(dt_s);
    detect_touch();
  }
}

// A stone that was pushed into another is freed of it in the steps that follow.
void World::slide_stones(double dt_s) {
  slide(truth_.stone, stone_, dt_s);
  truth_.stone.handle_rad += truth_.stone.spin_radps * dt_s;
  for (auto& other : truth_.others) {
    if (!moves(other)) continue;
    slide(other, stone_, dt_s);
    other.handle_rad += other.spin_radps * dt_s;
  }
  for (std::size_t i = 0; i < truth_.others.size(); ++i) {
    truth_.hits += collide(truth_.stone, truth_.others[i], stone_) ? 1 : 0;
    for (std::size_t k = 0; k < i; ++k) truth_.hits += collide(truth_.others[k], truth_.others[i], stone_) ? 1 : 0;
  }
}

// The held stone's centre is a point of the body; the belt turns it against the body.
void World::carry(double belt_radps) {
  const double s = std::sin(truth_.body.yaw_rad);
  const double c = std::cos(truth_.body.yaw_rad);
  const double across_mps = truth_.twist.yaw_radps * stone_.stone_x_m;
  truth_.stone = {.x_m = truth_.body.x_m - s * stone_.stone_x_m,
                  .y_m = truth_.body.y_m + c * stone_.stone_x_m,
                  .vx_mps = -s * truth_.twist.forward_mps - c * across_mps,
                  .vy_mps = c * truth_.twist.forward_mps - s * across_mps,
                  .spin_radps = belt_radps + truth_.twist.yaw_radps,
                  .handle_rad = truth_.stone.handle_rad};
}

// A stone that is let go by a robot that stands is set down; whoever takes it up again has not delivered it.
void World::release() {
  truth_.held = false;
  auto& stone = truth_.stone;
  if (std::hypot(stone.vx_mps, stone.vy_mps) < standing_mps) {
    truth_.set_down = truth_.stamp;
    stone.vx_mps = stone.vy_mps = 0.0;
    return;
  }
  const double before = std::hypot(stone.vx_mps, stone.vy_mps);
  const double speed = std::max(before - stone_.release_drag_mps, 0.0);
  if (before > 0.0) {
    stone.vx_mps *= speed / before;
    stone.vy_mps *= speed / before;
  }
  truth_.release = ReleaseRecord{.stamp = truth_.stamp,
                                 .stone_x_m = stone.x_m,
                                 .stone_y_m = stone.y_m,
                                 .speed_mps = speed,
                                 .heading_rad = std::atan2(-stone.vx_mps, stone.vy_mps),
                                 .spin_radps = stone.spin_radps,
                                 .hog_distance_m = tee_to_hog_m - truth_.body.y_m,
                                 .yaw_rad = truth_.body.yaw_rad};
}

void World::settle() {
  if (truth_.held) return;
  const auto any_moves = [&] { return moves(truth_.stone) || std::ranges::any_of(truth_.others, moves); };
  while (any_moves()) slide_stones(seconds(longest_step));
}

void World::stones_are(const SheetStones& sheet) {
  truth_.others = sheet.others;
  truth_.other_teams = sheet.other_teams;
  slides_elsewhere_ = truth_.release && sheet.thrown;
  if (slides_elsewhere_) truth_.stone = *sheet.thrown;
}

void World::put_back(const PlanarPose& body, int team, double handle_rad) {
  robot_.put(body);
  truth_.body = body;
  truth_.twist = {};
  truth_.release.reset();
  truth_.burned.reset();
  slides_elsewhere_ = false;
  truth_.stone.handle_rad = handle_rad;
  truth_.stone_team = team;
  carry(0.0);
  if (!truth_.held) truth_.set_down = truth_.stamp;
}

World::Offset World::from_jaws() const {
  const double dx = truth_.stone.x_m - truth_.body.x_m;
  const double dy = truth_.stone.y_m - truth_.body.y_m;
  const double s = std::sin(truth_.body.yaw_rad);
  const double c = std::cos(truth_.body.yaw_rad);
  return {.ahead_m = -s * dx + c * dy - stone_.stone_x_m, .left_m = -c * dx - s * dy};
}

bool World::stone_between_jaws() const {
  if (truth_.held || !truth_.set_down || truth_.release) return false;
  const Offset offset = from_jaws();
  return std::abs(offset.ahead_m) < stone_.front_clearance_m && std::abs(offset.left_m) < stone_.side_clearance_m;
}

void World::grip_again(const WorldInputs& inputs) {
  if (truth_.held || !inputs.stone_in_jaws || inputs.stone_free_at || !stone_between_jaws()) return;
  truth_.held = true;
  truth_.set_down.reset();
}

void World::detect_touch() {
  if (truth_.burned || !truth_.release) return;
  const auto [ahead, left] = from_jaws();
  const bool front = ahead < -stone_.front_clearance_m && std::abs(left) < 2.0 * stone_.radius_m;
  const bool fingers = ahead < stone_.finger_reach_m && std::abs(left) > stone_.side_clearance_m;
  if (front || (fingers && std::abs(left) < 2.0 * stone_.radius_m)) truth_.burned = truth_.stamp;
}

}  // namespace hogline::hw::sim
