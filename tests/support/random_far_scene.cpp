#include "tests/support/random_far_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hw/sim/mixed_bits.hpp"
#include "vision/geometry/sheet_camera.hpp"

namespace hogline::testing {
namespace {

using hw::sim::Colour;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double touching_m = 2.0 * vision::rules::stone_radius_m + 0.001;
constexpr double in_view_px = 40.0;  // a stone nearer to the picture's edge is not whole

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : seed_(hw::sim::mixed_bits(seed ^ 0x666172ULL)) {}
  double uniform(double from, double to) {
    return from + (to - from) * hw::sim::uniform_of(hw::sim::mixed_bits(seed_ + ++drawn_));
  }
  bool chance(double share) { return uniform(0.0, 1.0) < share; }
  int between(int least, int most) { return static_cast<int>(uniform(least, most + 1.0)); }

 private:
  std::uint64_t seed_;
  std::uint64_t drawn_ = 0;
};

/// From the mount that looks at a place: the camera's optical axis meets it, off the picture's middle by `off` radians.
vision::Mount looking_at(const PlanarPose& body, const vision::Mount& mount, const Eigen::Vector3d& place,
                         const Eigen::Vector2d& off) {
  const Eigen::Vector3d to = (vision::eMb(body).inverse() * place) - Eigen::Vector3d(mount.x_m, mount.y_m, mount.z_m);
  vision::Mount m = mount;
  m.yaw_rad = std::atan2(to.y(), to.x()) + off.x();
  m.pitch_rad = std::atan2(-to.z(), std::hypot(to.x(), to.y())) + off.y();
  return m;
}

void aim(Dice& dice, const FarMix& mix, const Eigen::Vector2d& target, FarScene& far) {
  RandomScene& s = far.scene;
  s.setup.intrinsics = {1600,
                        1200,
                        vision::LensModel::brown_conrady,
                        dice.uniform(5300.0, 5800.0),
                        0.0,
                        dice.uniform(790.0, 810.0),
                        dice.uniform(590.0, 610.0),
                        {dice.uniform(-0.05, 0.05), 0.0, 0.0, 0.0, 0.0}};
  s.setup.intrinsics.fy_px = s.setup.intrinsics.fx_px * dice.uniform(0.999, 1.001);
  s.body = {dice.uniform(-0.4, 0.4), dice.uniform(-5.0, -3.0), dice.uniform(-3.0, 3.0) * degree};
  const vision::Mount at{0.2, 0.0, dice.uniform(1.9, 2.2), dice.uniform(-0.3, 0.3) * degree, 0.0, 0.0};
  const Eigen::Vector2d off(dice.uniform(-1.5, 1.5) * degree, dice.uniform(-1.5, 1.5) * degree);
  s.setup.mount = looking_at(s.body, at, {target.x(), target.y(), 0.1}, off);
  s.true_mount = s.setup.mount;
  s.true_mount.pitch_rad += dice.uniform(-mix.most_tilt_rad, mix.most_tilt_rad);
  s.true_mount.yaw_rad += dice.uniform(-mix.most_pan_rad, mix.most_pan_rad);
  s.true_mount.roll_rad += 0.2 * dice.uniform(-mix.most_tilt_rad, mix.most_tilt_rad);
  far.planned = vision::eMb(s.body) * vision::bMc(s.setup.mount);
  s.eMc = vision::eMb(s.body) * vision::bMc(s.true_mount);
  s.exposure.eMc = s.eMc;
}

bool in_view(const vision::SheetCamera& camera, double x_m, double y_m) {
  const auto pixel = camera.project({x_m, y_m, 0.1});
  return pixel && camera.lens().in_picture(*pixel, in_view_px + 0.2 * 5500.0 / std::max(1.0, y_m + 3.0));
}

void add_look(Dice& dice, double x_m, double y_m, const Colour& plate, double granite, RandomScene& scene) {
  hw::sim::StoneLook look;
  look.x_m = x_m;
  look.y_m = y_m;
  look.handle_rad = dice.uniform(-3.1, 3.1);
  look.plate = plate;
  const auto g = static_cast<float>(granite);
  look.granite = {g, g, 1.03F * g};
  scene.exposure.stones.push_back(look);
}

}  // namespace

FarScene random_far_scene(std::uint64_t seed, const FarMix& mix) {
  Dice dice(seed);
  FarScene far;
  far.scene = random_scene(seed, {.most_stones = 0, .most_people = mix.most_people});
  RandomScene& s = far.scene;
  const double half_m = 0.5 * s.sheet_width_m - 0.15;
  const Eigen::Vector2d target(dice.uniform(-0.8, 0.8) * half_m, dice.uniform(7.0, 27.5));
  aim(dice, mix, target, far);
  const vision::SheetCamera camera(vision::Lens(s.setup.intrinsics), s.eMc, s.setup.ice);

  const int count = dice.between(mix.least_stones, mix.most_stones);
  const double granite = dice.uniform(0.13, 0.30);
  const Colour red{0.55F, 0.03F, 0.03F};
  const Colour yellow{0.72F, 0.52F, 0.03F};
  for (int k = 0, tried = 0; k < count && tried < 200; ++tried) {
    const bool first = k == 0;
    const double x_m = first ? target.x() : dice.uniform(-half_m, half_m);
    const double y_m = first ? target.y() : dice.uniform(6.8, 28.0);
    const bool taken = std::any_of(far.stones.begin(), far.stones.end(), [&](const BoardStone& b) {
      return std::hypot(b.x_m - x_m, b.y_m - y_m) < touching_m;
    });
    if (taken || (!first && !in_view(camera, x_m, y_m))) continue;
    far.stones.push_back({x_m, y_m, dice.chance(0.5)});
    add_look(dice, x_m, y_m, far.stones.back().red ? red : yellow, granite, s);
    ++k;
  }
  if (s.rink.sheet.neighbours) {
    for (int k = dice.between(0, mix.most_neighbours); k > 0; --k) {
      const double beyond_m = s.sheet_width_m / 2.0 + s.rink.sheet.neighbour_gap_m + 0.35 + dice.uniform(0.0, 2.5);
      add_look(dice, dice.chance(0.5) ? beyond_m : -beyond_m, dice.uniform(6.0, 30.0), dice.chance(0.5) ? red : yellow,
               granite, s);
    }
  }
  s.rink.sheet.logos.clear();
  const std::array<Colour, 5> paints{Colour{0.02F, 0.02F, 0.02F},
                                     {0.02F, 0.07F, 0.45F},
                                     {0.55F, 0.02F, 0.02F},
                                     {0.75F, 0.58F, 0.03F},
                                     {0.35F, 0.35F, 0.36F}};
  for (int k = dice.between(0, mix.most_logos); k > 0; --k) {
    const auto paint = static_cast<std::size_t>(dice.between(0, 4));
    s.rink.sheet.logos.push_back({dice.uniform(-1.6, 1.6), dice.uniform(8.5, 26.0), dice.uniform(0.3, 1.6),
                                  dice.uniform(0.3, 2.0), paints[paint]});
  }
  for (auto& person : s.exposure.people) {
    person.y_m = dice.uniform(6.0, 32.0);
    person.x_m = (dice.chance(0.5) ? 1.0 : -1.0) * dice.uniform(0.5, 3.0);
    if (far.stones.empty()) continue;
    // Sweepers are beside the stone or on its way, not before it.
    const Eigen::Vector3d eye = s.eMc.translation();
    const BoardStone& run = far.stones.front();
    const double at_stone = (run.x_m - eye.x()) / (run.y_m - eye.y());
    const double at_person = (person.x_m - eye.x()) / (person.y_m - eye.y());
    if (person.y_m < run.y_m + 1.0 && std::abs(at_stone - at_person) * (person.y_m - eye.y()) < 0.75) {
      person.x_m += std::copysign(1.5, at_person - at_stone);
    }
  }
  measure_visibility(s, far.stones);
  return far;
}

}  // namespace hogline::testing
