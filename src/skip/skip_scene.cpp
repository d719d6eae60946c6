#include "src/skip/skip_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "servo/skip_sheet.hpp"
#include "servo/stone_path.hpp"

namespace hogline {
namespace {

using hw::sim::FieldStone;
using servo::SlidingStone;

constexpr double release_y_m = 29.2;  // half a metre before the thrower's hog line, and the reach of its jaws
constexpr double spin_radps = 1.57;
constexpr double clear_m = 0.4;
constexpr double heading_sigma_rad = 0.0008;

class Draw {
 public:
  Draw(const hw::sim::Scenario& scenario, std::uint64_t seed)
      : random_(seed * 7919 + 17),
        ice_{scenario.stone.friction_scale, scenario.stone.curl_gain, scenario.stone.lateral_acceleration_mps2,
             scenario.stone.spin_decay_scale},
        half_width_m_(0.5 * scenario.sheet.width_m),
        spin_(between(0, 1) < 0.5 ? spin_radps : -spin_radps) {}

  double between(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }

  SlidingStone released(double speed, double heading) const {
    return {0.0, release_y_m, speed * std::sin(heading), -speed * std::cos(heading), spin_};
  }

  /// Heading with which a stone of this weight has this x where it crosses y, or rests.
  SlidingStone aimed_over(double x_m, double y_m, double speed) const {
    double heading = 0.0;
    for (int i = 0; i < 20; ++i) {
      const servo::StonePath path(released(speed, heading), ice_);
      const auto there = path.crossing_s(y_m);
      const double x = there ? path.at(*there).stone.x_m : path.rest().x_m;
      heading += (x_m - x) / (release_y_m - y_m);
    }
    return released(speed, heading);
  }

  double weight_for(double y_m) const {
    double low = 0.5, high = 4.0;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      (servo::rest_of(released(middle, 0.0), ice_).y_m > y_m ? low : high) = middle;
    }
    return high;
  }

  SlidingStone to_rest_at(double x_m, double y_m) const { return aimed_over(x_m, y_m + 0.01, weight_for(y_m)); }
  double spin() const { return spin_; }
  double half_width_m() const { return half_width_m_; }

  SlidingStone thrown_by_hand(SlidingStone s) {
    const double turn = heading_sigma_rad * std::normal_distribution<double>()(random_);
    const double vx = s.vx_mps + turn * s.vy_mps;
    s.vy_mps -= turn * s.vx_mps;
    s.vx_mps = vx;
    return s;
  }

 private:
  std::mt19937_64 random_;
  servo::IceFactors ice_;
  double half_width_m_;
  double spin_;
};

FieldStone at_rest(double x_m, double y_m, int team, double handle_rad) {
  FieldStone stone;
  stone.motion.x_m = x_m;
  stone.motion.y_m = y_m;
  stone.motion.handle_rad = handle_rad;
  stone.team = team;
  return stone;
}

bool clear_of(const SkipScene& scene, double x, double y) {
  return std::all_of(scene.standing.begin(), scene.standing.end(),
                     [&](const FieldStone& s) { return std::hypot(s.motion.x_m - x, s.motion.y_m - y) > clear_m; });
}

void add_bystanders(SkipScene& scene, int count, Draw& draw) {
  for (int tries = 0; count > 0 && tries < 500; ++tries) {
    const double x = draw.between(-1.8, 1.8), y = draw.between(-1.5, 5.5);
    if (!clear_of(scene, x, y)) continue;
    scene.standing.push_back(at_rest(x, y, draw.between(0, 1) < 0.5 ? 0 : 1, draw.between(0, std::numbers::pi)));
    --count;
  }
}

/// A target and, behind it on the line it will take, a second one.
SlidingStone add_targets(SkipScene& scene, bool two, Draw& draw) {
  const double x = draw.between(-0.8, 0.8), y = draw.between(-0.5, 3.0), aside = draw.between(-0.2, 0.2);
  scene.standing.push_back(at_rest(x, y, 1, draw.between(0, std::numbers::pi)));
  const double speed = draw.weight_for(draw.between(-14.0, -4.0));
  if (two) {
    const double angle = std::asin(std::clamp(-aside / 0.29, -1.0, 1.0)) * 0.9;
    const double away = draw.between(0.45, 1.2), off = draw.between(-0.12, 0.12);
    scene.standing.push_back(at_rest(x + away * std::sin(angle) + off * std::cos(angle),
                                     y - away * std::cos(angle) + off * std::sin(angle), 0,
                                     draw.between(0, std::numbers::pi)));
  }
  return draw.aimed_over(x + aside, y + 0.25, speed);
}

SlidingStone shot_of(ThrowKind kind, SkipScene& scene, Draw& draw) {
  const double y_through = draw.between(-5.0, -3.0);
  switch (kind) {
    case ThrowKind::draw:
      return draw.to_rest_at(draw.between(-1.0, 1.0), draw.between(-1.2, 1.5));
    case ThrowKind::guard:
      return draw.to_rest_at(draw.between(-1.0, 1.0), draw.between(2.2, 5.5));
    case ThrowKind::hit:
      return add_targets(scene, false, draw);
    case ThrowKind::double_hit:
      return add_targets(scene, true, draw);
    case ThrowKind::through:
      return draw.aimed_over(draw.between(-1.0, 1.0), 0.0, draw.weight_for(y_through));
    case ThrowKind::hogged:
      return draw.to_rest_at(draw.between(-1.0, 1.0), draw.between(6.7, 9.0));
    case ThrowKind::sideline:
      return draw.aimed_over((draw.spin() > 0 ? 1.0 : -1.0) * (draw.half_width_m() + 0.2), draw.between(2.0, 6.0),
                             draw.weight_for(-3.0));
  }
  return {};
}

}  // namespace

const std::vector<std::string>& throw_kind_names() {
  static const std::vector<std::string> names{"draw", "guard", "hit", "double", "through", "hogged", "sideline"};
  return names;
}

std::optional<ThrowKind> throw_kind(std::string_view name) {
  const auto& names = throw_kind_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<ThrowKind>(found - names.begin());
}

SkipScene draw_scene(ThrowKind kind, const hw::sim::Scenario& scenario, std::uint64_t seed) {
  Draw draw(scenario, seed * 16 + static_cast<std::uint64_t>(kind));
  SkipScene scene;
  const SlidingStone s = draw.thrown_by_hand(shot_of(kind, scene, draw));
  add_bystanders(scene, static_cast<int>(draw.between(0.0, 5.0)), draw);
  scene.thrown.motion = {.x_m = s.x_m,
                         .y_m = s.y_m,
                         .vx_mps = s.vx_mps,
                         .vy_mps = s.vy_mps,
                         .spin_radps = s.spin_radps,
                         .handle_rad = draw.between(0.0, std::numbers::pi)};
  scene.thrown.team = 0;
  return scene;
}

}  // namespace hogline
