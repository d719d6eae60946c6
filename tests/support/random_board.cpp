#include "tests/support/random_board.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hw/sim/mixed_bits.hpp"
#include "hw/sim/solids.hpp"
#include "vision/geometry/stone_shape.hpp"

namespace hogline::testing {
namespace {

using hw::sim::Colour;

constexpr double touching_m = 2.0 * vision::rules::stone_radius_m + 0.001;
constexpr double clear_of_camera_m = 1.6;

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : seed_(hw::sim::mixed_bits(seed ^ 0x626f617264ULL)) {}
  double uniform(double from, double to) {
    return from + (to - from) * hw::sim::uniform_of(hw::sim::mixed_bits(seed_ + ++drawn_));
  }
  bool chance(double share) { return uniform(0.0, 1.0) < share; }
  int upto(int most) { return static_cast<int>(uniform(0.0, most + 1.0)); }

 private:
  std::uint64_t seed_;
  std::uint64_t drawn_ = 0;
};

bool is_free(const std::vector<BoardStone>& stones, double x_m, double y_m) {
  return std::none_of(stones.begin(), stones.end(),
                      [&](const BoardStone& s) { return std::hypot(s.x_m - x_m, s.y_m - y_m) < touching_m - 1e-6; });
}

struct Limits {
  double half_width_m;
  double min_y_m;
  double max_y_m = 6.2;
  bool contain(double x_m, double y_m) const { return std::abs(x_m) < half_width_m && y_m > min_y_m && y_m < max_y_m; }
};

// A stone anywhere, or one that touches the last one.
bool add_stone(Dice& dice, const Limits& limits, bool touching, std::vector<BoardStone>& stones) {
  for (int attempt = 0; attempt < 50; ++attempt) {
    double x_m = dice.uniform(-limits.half_width_m, limits.half_width_m);
    double y_m = dice.chance(0.6) ? dice.uniform(limits.min_y_m, 2.0) : dice.uniform(2.0, limits.max_y_m);
    if (touching) {
      const double angle = dice.uniform(0.0, 2.0 * std::numbers::pi);
      x_m = stones.back().x_m + touching_m * std::cos(angle);
      y_m = stones.back().y_m + touching_m * std::sin(angle);
    }
    if (!limits.contain(x_m, y_m) || !is_free(stones, x_m, y_m)) continue;
    stones.push_back({x_m, y_m, dice.chance(0.5)});
    return true;
  }
  return false;
}

/// Everything that can stand before a stone.
class Sight {
 public:
  explicit Sight(const RandomScene& scene)
      : eye_(scene.eMc.translation()), camera_(vision::Lens(scene.setup.intrinsics), scene.eMc, scene.setup.ice) {
    const hw::sim::Exposure& exposure = scene.exposure;
    for (const auto& look : exposure.stones) solids_.push_back(hw::sim::Solid::stone(look));
    stones_ = solids_.size();
    for (const auto& look : exposure.people) solids_.push_back(hw::sim::Solid::person(look));
  }

  bool sees(const Eigen::Vector3d& point, std::size_t own) const {
    const auto pixel = camera_.project(point);
    if (!pixel || !camera_.lens().in_picture(*pixel)) return false;
    const hw::sim::Ray ray{eye_.cast<float>(), (point - eye_).cast<float>()};
    for (std::size_t i = 0; i < solids_.size(); ++i) {
      if (i == own) continue;
      const auto hit = solids_[i].meet(ray);
      if (hit && hit->distance < 1.0F) return false;
    }
    return true;
  }

  /// Share of the pixels in which a stone alone would be seen, that show it. None in the picture: 0.
  double pixel_share(const BoardStone& stone, std::size_t own) const {
    const auto centre = camera_.project({stone.x_m, stone.y_m, 0.09});
    const auto side = camera_.project({stone.x_m, stone.y_m, 0.29});
    if (!centre || !side) return 0.0;
    const double reach_px = 1.2 * (*side - *centre).norm() + 3.0;  // 0.2 m and more to each side
    const double step_px = std::max(1.0, reach_px / 24.0);
    int covered = 0;
    int shown = 0;
    for (double dy = -reach_px; dy <= reach_px; dy += step_px) {
      for (double dx = -reach_px; dx <= reach_px; dx += step_px) {
        const Eigen::Vector2d pixel(centre->x() + dx, centre->y() + dy);
        const auto direction = camera_.lens().ray(pixel);
        if (!direction) continue;
        const hw::sim::Ray ray{eye_.cast<float>(), (camera_.eMc().linear() * *direction).cast<float>()};
        const auto hit = solids_[own].meet(ray);
        if (!hit) continue;
        ++covered;
        shown += camera_.lens().in_picture(pixel) && is_first(ray, hit->distance, own) ? 1 : 0;
      }
    }
    return covered > 0 ? static_cast<double>(shown) / covered : 0.0;
  }

 private:
  bool is_first(const hw::sim::Ray& ray, float distance, std::size_t own) const {
    for (std::size_t i = 0; i < solids_.size(); ++i) {
      if (i == own) continue;
      const auto hit = solids_[i].meet(ray);
      if (hit && hit->distance < distance) return false;
    }
    return true;
  }

  Eigen::Vector3d eye_;
  vision::SheetCamera camera_;
  std::vector<hw::sim::Solid> solids_;
  std::size_t stones_ = 0;
};

}  // namespace

void measure_visibility(const RandomScene& scene, std::vector<BoardStone>& stones) {
  const Sight sight(scene);
  const Eigen::Vector3d eye = scene.eMc.translation();
  for (std::size_t i = 0; i < stones.size(); ++i) {
    BoardStone& s = stones[i];
    const vision::Bearing bearing = vision::bearing_of({s.x_m, s.y_m}, eye);
    int handle = 0;
    int body = 0;
    int rim = 0;
    constexpr int points = 48;
    for (int k = 0; k < points; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / points;
      const double part = std::sqrt((k % 4 + 0.5) / 4.0);
      handle += sight.sees(vision::circle_point({s.x_m, s.y_m}, bearing, 0.095 * part, 0.126, angle), i) ? 1 : 0;
      rim += sight.sees(vision::circle_point({s.x_m, s.y_m}, bearing, 0.095, 0.126, angle), i) ? 1 : 0;
      const double front = -std::numbers::pi * (k + 0.5) / points;
      body +=
          sight.sees(vision::circle_point({s.x_m, s.y_m}, bearing, 0.1455, 0.03 + 0.02 * (k % 4), front), i) ? 1 : 0;
    }
    s.handle_seen = static_cast<double>(handle) / points;
    s.rim_seen = static_cast<double>(rim) / points;
    s.body_seen = static_cast<double>(body) / points;
    s.in_sight = sight.pixel_share(s, i);
  }
}

RandomBoard random_board(std::uint64_t seed, const BoardMix& mix) {
  Dice dice(seed);
  RandomBoard board;
  board.scene = random_scene(seed, {.most_stones = 0, .most_people = mix.most_people});
  const Limits limits{0.5 * board.scene.sheet_width_m - 0.15,
                      std::max(board.scene.body.y_m + clear_of_camera_m + 0.4, -2.0)};
  const int count = dice.upto(mix.most_stones);
  while (static_cast<int>(board.stones.size()) < count) {
    const int clump = dice.chance(0.5) ? 1 : 1 + dice.upto(mix.most_in_clump - 1);
    for (int k = 0; k < clump && static_cast<int>(board.stones.size()) < count; ++k) {
      if (!add_stone(dice, limits, k > 0, board.stones)) break;
    }
  }
  const double granite = dice.uniform(0.13, 0.30);
  const double bright = dice.uniform(0.7, 1.2);
  for (const BoardStone& s : board.stones) {
    hw::sim::StoneLook look;
    look.x_m = s.x_m;
    look.y_m = s.y_m;
    look.handle_rad = dice.uniform(-3.1, 3.1);
    const Colour plate = s.red ? Colour{0.55F, 0.03F, 0.03F} : Colour{0.72F, 0.52F, 0.03F};
    const auto b = static_cast<float>(bright);
    look.plate = {b * plate.red, b * plate.green, b * plate.blue};
    const auto g = static_cast<float>(granite);
    look.granite = {g, g, 1.03F * g};
    board.scene.exposure.stones.push_back(look);
  }
  measure_visibility(board.scene, board.stones);
  return board;
}

}  // namespace hogline::testing
