#include "hw/sim/people.hpp"

#include <cmath>
#include <numbers>

#include "hw/sim/mixed_bits.hpp"

namespace hogline::hw::sim {
namespace {

constexpr double first_y_m = -2.0;  // of e
constexpr double last_y_m = 8.0;
constexpr double beyond_nearest_m = 0.8;  // people stand up to this much further out
constexpr double longest_stride_m = 0.5;
constexpr double step_length_m = 0.7;
constexpr std::uint64_t stream = 0x70656f706c65ULL;

// To and fro between the ends at an even pace: how far along, and which way.
struct Pace {
  double way_m = 0.0;
  bool forth = true;
};
Pace pace_of(double way_m) {
  constexpr double length_m = last_y_m - first_y_m;
  const double round = std::fmod(way_m, 2.0 * length_m);
  return round < length_m ? Pace{round, true} : Pace{2.0 * length_m - round, false};
}

PersonLook person(const PeopleScenario& scenario, std::uint64_t seed, double t_s) {
  std::uint64_t drawn = 0;
  const auto draw = [&] { return uniform_of(mixed_bits(seed + ++drawn)); };
  const double side = draw() < 0.5 ? -1.0 : 1.0;
  const double out_m = scenario.nearest_x_m + beyond_nearest_m * draw();
  const double start_m = 2.0 * (last_y_m - first_y_m) * draw();
  const double speed_mps = draw() < 0.5 ? 0.0 : scenario.walk_mps * draw();
  const Pace pace = pace_of(start_m + speed_mps * t_s);
  PersonLook look;
  look.x_m = side * out_m;
  look.y_m = first_y_m + pace.way_m;
  look.height_m = 1.55 + 0.4 * draw();
  const auto shade = [&] { return static_cast<float>(0.03 + 0.6 * draw() * draw()); };
  look.jacket = {shade(), shade(), shade()};
  look.trousers = {0.3F * shade(), 0.3F * shade(), 0.3F * shade()};
  if (speed_mps > 0.0) {
    look.facing_rad = pace.forth ? 0.0 : std::numbers::pi;
    look.stride_m = longest_stride_m * std::sin(std::numbers::pi * pace.way_m / step_length_m);
  } else {
    look.facing_rad = 2.0 * std::numbers::pi * draw();
  }
  return look;
}

}  // namespace

std::vector<PersonLook> people_at(const PeopleScenario& scenario, std::uint64_t seed, Stamp stamp) {
  std::vector<PersonLook> people;
  const double t_s = seconds(stamp.time_since_epoch());
  for (int i = 0; i < scenario.count; ++i) {
    people.push_back(person(scenario, mixed_bits(mixed_bits(seed ^ stream) + static_cast<std::uint64_t>(i)), t_s));
  }
  return people;
}

}  // namespace hogline::hw::sim
