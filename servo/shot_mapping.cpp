#include "servo/shot_mapping.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "servo/first_contact.hpp"
#include "servo/game/board.hpp"

namespace hogline::servo {
namespace {

constexpr double fastest_mps = 10.0;
constexpr double quarter_turn_radps = 0.5 * std::numbers::pi;  // of every stone of Digital Curling
constexpr double slowest_leaving_mps = 0.1;  // a release for exactly 0 at the line would be one that rests on it
constexpr double same_place_m = 5e-3;
constexpr double same_exit_m = 0.5;  // along a sideline that it nears at a few degrees
using in_sheet::stone_radius_m;

double heading(const SlidingStone& stone) { return std::atan2(-stone.vx_mps, stone.vy_mps); }

IntendedOutcome outcome_at(Intent intent, const SlidingStone& stone, std::size_t touched = 0) {
  return {intent, {stone.x_m, stone.y_m}, speed_mps(stone), heading(stone), touched};
}

/// When it first touches a sideline; a stone's way is smooth: a hundredth of a second misses nothing that counts.
std::optional<double> side_s(const StonePath& path, double sheet_width_m) {
  const auto outside = [&](double after_s) {
    return std::abs(path.at(after_s).stone.x_m) + stone_radius_m >= 0.5 * sheet_width_m;
  };
  const double rest_s = path.rest().after_s, step_s = 0.01;
  for (double after_s = 0.0; after_s < rest_s + step_s; after_s += step_s) {
    if (outside(std::min(after_s, rest_s))) return std::min(after_s, rest_s);
  }
  return std::nullopt;
}

std::optional<double> leaves_s(const StonePath& path, const std::optional<double>& sheet_width_m) {
  const auto through_s = path.crossing_s(in_sheet::back_y_m + stone_radius_m);
  const auto aside_s = sheet_width_m ? side_s(path, *sheet_width_m) : std::nullopt;
  if (through_s && aside_s) return std::min(*through_s, *aside_s);
  return through_s ? through_s : aside_s;
}

IntendedOutcome outcome_of(const StonePath& path, const Surroundings& around) {
  const auto contact = first_contact(path, around.stones);
  const auto leaving = leaves_s(path, around.sheet_width_m);
  if (contact && (!leaving || contact->after_s < *leaving))
    return outcome_at(Intent::touch, contact->striker, contact->stone);
  if (leaving) return outcome_at(Intent::leave, path.at(*leaving).stone);
  const Rest rest = path.rest();
  return {Intent::rest, {rest.x_m, rest.y_m}, 0.0, 0.0, 0};
}

std::string impossible(const HackShot& shot) {
  if (!std::isfinite(shot.vx_mps) || !std::isfinite(shot.vy_mps)) return "the shot's velocity is not finite";
  if (std::hypot(shot.vx_mps, shot.vy_mps) > fastest_mps) return "the shot is faster than any stone";
  if (shot.vy_mps <= 0.0) return "the shot does not go down-ice";
  return {};
}

void aim_to_rest(MappedShot& mapped, const HackShot& shot, const Surroundings& around, const ThrowerSkill& skill,
                 const IceModel& ice) {
  const ShotAim aim = aim_shot({mapped.intended.place, shot.curl, around.stones}, skill, ice);
  mapped.ok = aim.ok;
  mapped.reason = aim.reason;
  mapped.order = aim.order;
  mapped.sigma_m = std::sqrt(aim.covariance.xx_m2 + aim.covariance.yy_m2);
}

void aim_to_pass(MappedShot& mapped, const HackShot& shot, const Surroundings& around, const ThrowerSkill& skill,
                 const IceModel& ice) {
  HitWish wish{mapped.intended.place, mapped.intended.speed_mps, shot.curl, around.stones};
  if (mapped.intended.intent == Intent::touch)
    wish.stones.erase(wish.stones.begin() + static_cast<std::ptrdiff_t>(mapped.intended.stone));
  else
    wish.speed_mps = std::max(wish.speed_mps, slowest_leaving_mps);
  const HitAim aim = aim_hit(wish, skill, ice);
  mapped.ok = aim.ok;
  mapped.reason = aim.reason;
  mapped.order = aim.order;
  mapped.sigma_m = aim.aside_sigma_m;
}

/// The order once more, with all stones in its way: it must come to the same.
void check(MappedShot& mapped, const Surroundings& around, const ThrowerSkill& skill, const IceModel& ice) {
  const Place from = release_place(skill, mapped.order.heading_rad);
  const StonePath path(released(mapped.order, from), ice.estimate().factors());
  mapped.expected = outcome_of(path, around);
  const IntendedOutcome &is = mapped.expected, &should = mapped.intended;
  mapped.off_m = std::hypot(is.place.x_m - should.place.x_m, is.place.y_m - should.place.y_m);
  mapped.off_heading_rad = is.heading_rad - should.heading_rad;
  const double same_m = should.intent == Intent::leave ? same_exit_m : same_place_m;
  if (is.intent == should.intent && is.stone == should.stone && mapped.off_m < same_m) return;
  mapped.ok = false;
  mapped.reason = "on this ice the stone comes from another side and can not be brought there";
}

}  // namespace

IntendedOutcome intended_outcome(const HackShot& shot, const Surroundings& around) {
  const double spin = shot.curl == Curl::counter_clockwise ? quarter_turn_radps : -quarter_turn_radps;
  return outcome_of(StonePath({0.0, 0.0, shot.vx_mps, shot.vy_mps, spin}, IceFactors{}), around);
}

std::optional<HackShot> hack_shot_for(const IntendedOutcome& outcome, Curl curl) {
  const IceModel fcv1({}, IceEstimate{1.0, 1.0, 0.0, {1e-6, 0, 0, 0, 1e-6, 0, 0, 0, 1e-12}, 1});
  const ThrowerSkill hack{.release = {0.0, 0.0}, .max_speed_mps = fastest_mps, .spin_radps = quarter_turn_radps};
  const auto shot = [&](const auto& aim) -> std::optional<HackShot> {
    if (!aim.ok) return std::nullopt;
    const SlidingStone stone = released(aim.order, hack.release);
    return HackShot{stone.vx_mps, stone.vy_mps, curl};
  };
  if (outcome.intent == Intent::rest) return shot(aim_shot({outcome.place, curl, {}}, hack, fcv1));
  return shot(aim_hit({outcome.place, outcome.speed_mps, curl, {}}, hack, fcv1));
}

MappedShot map_shot(const HackShot& shot, const Surroundings& around, const ThrowerSkill& skill, const IceModel& ice) {
  MappedShot mapped;
  mapped.reason = impossible(shot);
  if (!mapped.reason.empty()) return mapped;
  mapped.intended = intended_outcome(shot, around);
  if (mapped.intended.intent == Intent::rest)
    aim_to_rest(mapped, shot, around, skill, ice);
  else
    aim_to_pass(mapped, shot, around, skill, ice);
  if (mapped.ok) check(mapped, around, skill, ice);
  return mapped;
}

}  // namespace hogline::servo
