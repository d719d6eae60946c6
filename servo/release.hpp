// When the stone is let go: at the release plane, the gripper's delay ahead, and only where it may be let go.
#pragma once

#include <optional>
#include <string>

#include "servo/hog_distance_filter.hpp"
#include "servo/thrower_config.hpp"

namespace hogline::servo {

/// A stone's centre must not come nearer than one radius to the hog line's house-side edge before it is released.
inline constexpr double stone_to_hog_line_m = 0.145;

enum class ReleaseVerdict {
  wait,     ///< not yet
  release,  ///< order it now
  never,    ///< it can not be had any more; `reason` says why
};

struct ReleaseDecision {
  ReleaseVerdict verdict = ReleaseVerdict::wait;
  std::string reason;
  std::optional<Stamp> predicted;  ///< when the release plane will be crossed
  Duration in{};                   ///< release: its moment within this period, from its beginning
  double place_sigma_m = 0.0;      ///< of the body's distance at that moment
};

/// What is known when a release is judged.
struct ReleaseOutlook {
  Stamp now{};
  Duration dt{};  ///< the control period: the next chance comes this much later
  double heading_rad = 0.0;
  double lateral_m = 0.0;
  double wanted_heading_rad = 0.0;
  double wanted_speed_mps = 0.0;  ///< the set-point of this moment
  double spin_error_radps = 0.0;
};

/// Where the stone's centre would be if the body's origin were at this distance: distance from the line, positive
/// before.
double stone_distance_m(double hog_distance_m, double heading_rad, const ReleaseConfig& config);

/// Whether a release can still be valid: place known well enough, speed, heading, line and spin within tolerance. Empty
/// when it can, else the reason why not.
std::optional<std::string> no_valid_release(const ReleaseConfig& release, const RunConfig& run,
                                            const HogDistanceFilter& filter, const ReleaseOutlook& outlook);

/// The decision of one control period: to release when the wanted moment lies within it, at that moment. `never` when
/// the stone would come free outside the window, or nearer to the line than the rule allows.
ReleaseDecision decide_release(const ReleaseConfig& release, const RunConfig& run, const HogDistanceFilter& filter,
                               const ReleaseOutlook& outlook);

}  // namespace hogline::servo
