#include "hw/sim/stone_field.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <random>
#include <utility>

#include "hw/sim/stone_motion.hpp"

namespace hogline::hw::sim {
namespace {

constexpr Duration longest_step = std::chrono::milliseconds(1);
constexpr double back_line_m = 1.829;  // behind the tee (World Curling)
constexpr double caught_behind_m = 0.6;
constexpr double caught_beside_m = 0.3;
constexpr int most_rounds = 8;  // of one moment, in a row of stones that touch

double speed(const StoneTruth& s) { return std::hypot(s.vx_mps, s.vy_mps); }

}  // namespace

StoneField::StoneField(const StoneScenario& scenario, double sheet_width_m, std::vector<FieldStone> standing,
                       std::uint64_t seed, Stamp start)
    : scenario_(scenario),
      friction_scale_(scenario.friction_scale),
      sheet_width_m_(sheet_width_m),
      stones_(std::move(standing)),
      now_(start) {
  begin_throw(seed);
}

void StoneField::begin_throw(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const double scatter = scenario_.throw_friction_sigma * std::normal_distribution<double>()(random);
  scenario_.friction_scale = friction_scale_ * (1.0 + scatter);
  contacts_.clear();
}

void StoneField::take_off(std::size_t number) {
  FieldStone& stone = stones_.at(number);
  stone.taken_off = true;
  stone.motion.vx_mps = stone.motion.vy_mps = stone.motion.spin_radps = 0.0;
}

void StoneField::put(std::size_t number, double x_m, double y_m) {
  FieldStone& stone = stones_.at(number);
  stone.taken_off = false;
  stone.motion = {.x_m = x_m, .y_m = y_m, .handle_rad = stone.motion.handle_rad};
}

int StoneField::add(const FieldStone& stone) {
  stones_.push_back(stone);
  return static_cast<int>(stones_.size()) - 1;
}

void StoneField::step(Stamp until) {
  assert(until >= now_);
  while (now_ < until) {
    const Stamp end = std::min(now_ + longest_step, until);
    slide_all(seconds(end - now_));
    now_ = end;
    collide_all();
    catch_those_out();
  }
}

bool StoneField::at_rest() const {
  return std::none_of(stones_.begin(), stones_.end(),
                      [](const FieldStone& s) { return !s.taken_off && speed(s.motion) > 0.0; });
}

void StoneField::slide_all(double dt_s) {
  for (FieldStone& stone : stones_) {
    if (stone.taken_off || !moves(stone.motion)) continue;
    slide(stone.motion, scenario_, dt_s);
    stone.motion.handle_rad += stone.motion.spin_radps * dt_s;
  }
}

// A stone that is struck into its neighbour hands on what it got in the same moment.
void StoneField::collide_all() {
  bool any = true;
  for (int round = 0; any && round < most_rounds; ++round) {
    any = false;
    for (std::size_t i = 0; i < stones_.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        StoneTruth &a = stones_[k].motion, &b = stones_[i].motion;
        if (stones_[i].taken_off || stones_[k].taken_off || (!moves(a) && !moves(b))) continue;
        const bool a_strikes = speed(a) > speed(b);
        if (!collide(a, b, scenario_)) continue;
        any = true;
        const int first = static_cast<int>(k), second = static_cast<int>(i);
        contacts_.push_back(
            {now_, a_strikes ? first : second, a_strikes ? second : first, a_strikes ? speed(b) : speed(a)});
      }
    }
  }
}

void StoneField::catch_those_out() {
  for (FieldStone& stone : stones_) {
    StoneTruth& s = stone.motion;
    const bool behind = s.y_m < -back_line_m - scenario_.radius_m - caught_behind_m;
    const bool beside = std::abs(s.x_m) > 0.5 * sheet_width_m_ + caught_beside_m;
    if (stone.taken_off || !(behind || beside)) continue;
    stone.taken_off = true;
    s.vx_mps = s.vy_mps = s.spin_radps = 0.0;
  }
}

}  // namespace hogline::hw::sim
