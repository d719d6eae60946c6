#include "servo/release.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace hogline::servo {
namespace {

constexpr double rule_sigmas = 3.0;   // of the place, kept clear of the line
constexpr double place_sigmas = 2.0;  // of the place, to lie within the tolerance

std::string with_numbers(const char* what, double is, double allowed, const char* unit) {
  std::ostringstream text;
  text.precision(4);
  text << what << ' ' << is << ' ' << unit << " (allowed " << allowed << ')';
  return text.str();
}

ReleaseDecision never(ReleaseDecision decision, std::string reason) {
  decision.verdict = ReleaseVerdict::never;
  decision.reason = std::move(reason);
  return decision;
}

}  // namespace

double stone_distance_m(double hog_distance_m, double heading_rad, const ReleaseConfig& config) {
  return hog_distance_m - config.stone_x_m * std::cos(heading_rad);
}

std::optional<std::string> no_valid_release(const ReleaseConfig& release, const RunConfig& run,
                                            const HogDistanceFilter& filter, const ReleaseOutlook& outlook) {
  const auto crossing = filter.crossing(outlook.now, release.hog_distance_m);
  if (!crossing) return "the body does not move towards the line";
  const double place = place_sigmas * crossing->hog_distance_sigma_m;
  const double speed =
      std::abs(filter.at(outlook.now).speed_mps / std::cos(outlook.heading_rad) - outlook.wanted_speed_mps);
  const double heading =
      std::abs(std::remainder(outlook.heading_rad - outlook.wanted_heading_rad, 2.0 * std::numbers::pi));
  // Written so that a value that is not a number fails.
  if (!(place <= release.tolerance_m)) {
    return with_numbers("place at the release is uncertain by", place, release.tolerance_m, "m");
  }
  if (!(speed <= run.speed_tolerance_mps)) {
    return with_numbers("speed is off by", speed, run.speed_tolerance_mps, "m/s");
  }
  if (!(heading <= run.heading_tolerance_rad)) {
    return with_numbers("heading is off by", heading, run.heading_tolerance_rad, "rad");
  }
  if (!(std::abs(outlook.lateral_m) <= run.lateral_tolerance_m)) {
    return with_numbers("off the shot's line by", std::abs(outlook.lateral_m), run.lateral_tolerance_m, "m");
  }
  if (!(std::abs(outlook.spin_error_radps) <= run.spin_tolerance_radps)) {
    return with_numbers("spin is off by", std::abs(outlook.spin_error_radps), run.spin_tolerance_radps, "rad/s");
  }
  return std::nullopt;
}

ReleaseDecision decide_release(const ReleaseConfig& release, const RunConfig& run, const HogDistanceFilter& filter,
                               const ReleaseOutlook& outlook) {
  ReleaseDecision decision;
  const auto crossing = filter.crossing(outlook.now, release.hog_distance_m);
  if (!crossing) return decision;
  decision.predicted = crossing->stamp;
  decision.place_sigma_m = crossing->hog_distance_sigma_m;
  const double ahead_s = seconds(crossing->stamp - outlook.now) - release.gripper_delay_s;
  if (ahead_s >= seconds(outlook.dt)) return decision;

  decision.in = from_seconds(std::max(0.0, ahead_s));
  const Stamp free = outlook.now + decision.in + from_seconds(release.gripper_delay_s);
  const double freed_at_m = filter.at(free).hog_distance_m;
  const double off_m = std::abs(freed_at_m - release.hog_distance_m);
  const double stone_m = stone_distance_m(freed_at_m, outlook.heading_rad, release);
  const double clear_m = stone_to_hog_line_m + rule_sigmas * decision.place_sigma_m;
  if (!(off_m <= release.tolerance_m)) {
    return never(decision, with_numbers("past the release plane by", off_m, release.tolerance_m, "m"));
  }
  if (!(stone_m >= clear_m)) {
    return never(decision, with_numbers("stone too near to the hog line:", stone_m, clear_m, "m"));
  }
  if (const auto reason = no_valid_release(release, run, filter, outlook)) return never(decision, *reason);
  decision.verdict = ReleaseVerdict::release;
  return decision;
}

}  // namespace hogline::servo
