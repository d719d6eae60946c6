#include "hw/sim/skip_people.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hw/sim/mixed_bits.hpp"

namespace hogline::hw::sim {
namespace {

constexpr double sweeper_aside_m = 0.8;
constexpr double sweeper_ahead_m = 0.5;
constexpr double step_length_m = 0.7;
constexpr double longest_stride_m = 0.5;
constexpr double passer_share = 0.5;  // of the way from the eye to the stone
constexpr double passer_mps = 1.5;    // comes in and leaves across the line of sight
constexpr double passer_seen_s = 1.2;
constexpr double body_radius_m = 0.25;

PersonLook person(std::uint64_t seed, int number) {
  std::uint64_t drawn = mixed_bits(seed ^ 0x736b6970ULL) + 16 * static_cast<std::uint64_t>(number);
  const auto draw = [&] { return uniform_of(mixed_bits(++drawn)); };
  const auto shade = [&] { return static_cast<float>(0.03 + 0.6 * draw() * draw()); };
  PersonLook look;
  look.height_m = 1.6 + 0.3 * draw();
  look.jacket = {shade(), shade(), shade()};
  look.trousers = {0.3F * shade(), 0.3F * shade(), 0.3F * shade()};
  return look;
}

PersonLook sweeper(const StoneTruth& stone, int number, std::uint64_t seed) {
  PersonLook look = person(seed, number);
  look.x_m = stone.x_m + (number == 0 ? -1.0 : 1.0) * sweeper_aside_m;
  look.y_m = stone.y_m - (1.0 + 0.6 * number) * sweeper_ahead_m;
  look.facing_rad = (number == 0 ? -0.5 : 0.5) * std::numbers::pi;
  look.stride_m = longest_stride_m * std::sin(std::numbers::pi * stone.y_m / step_length_m);
  return look;
}

}  // namespace

std::vector<PersonLook> people_about(const StoneTruth& thrown, double after_release_s, const SkipScenario& skip,
                                     double eye_x_m, double eye_y_m, std::uint64_t seed) {
  std::vector<PersonLook> people;
  const bool runs = std::hypot(thrown.vx_mps, thrown.vy_mps) > 0.05;
  for (int i = 0; i < skip.sweepers && runs && thrown.y_m > -0.5; ++i) people.push_back(sweeper(thrown, i, seed));
  for (std::size_t i = 0; i < skip.passers.size(); ++i) {
    const PasserScenario& p = skip.passers[i];
    const double in_s = std::max(0.0, p.from_s - after_release_s);
    const double out_s = std::max(0.0, after_release_s - p.from_s - p.for_s);
    if (in_s > passer_seen_s || out_s > passer_seen_s) continue;
    PersonLook look = person(seed, 10 + static_cast<int>(i));
    look.height_m = 1.9;
    look.x_m = eye_x_m + passer_share * (thrown.x_m - eye_x_m) + passer_mps * (out_s - in_s);
    look.y_m = eye_y_m + passer_share * (thrown.y_m - eye_y_m);
    look.facing_rad = -0.5 * std::numbers::pi;
    people.push_back(look);
  }
  return people;
}

bool hides(const PersonLook& person, const std::array<double, 3>& eye_m, const std::array<double, 3>& place_m) {
  const double dx = place_m[0] - eye_m[0], dy = place_m[1] - eye_m[1];
  const double length = std::hypot(dx, dy);
  if (length <= 0.0) return false;
  const double px = person.x_m - eye_m[0], py = person.y_m - eye_m[1];
  const double along = (px * dx + py * dy) / length;
  const double across = std::abs(px * dy - py * dx) / length;
  if (along <= 0.0 || along >= length || across > body_radius_m) return false;
  return eye_m[2] + along / length * (place_m[2] - eye_m[2]) < person.height_m;
}

}  // namespace hogline::hw::sim
