// The shot that brings the stone to the far tee on a known ice.
#pragma once

#include "hw/sim/scenario.hpp"
#include "hw/sim/truth.hpp"
#include "servo/shot.hpp"

namespace hogline::campaign {

/// Solved by throwing on the scenario's ice (without what differs from throw to throw) from where the robot starts: its
/// place is known to a millimetre once it has looked. The stone leaves the jaws `hog_distance_m` before the hog line,
/// `stone_x_m` ahead of the robot's origin. Precondition: a stone that can get there.
servo::ShotOrder tee_draw(const hw::sim::Scenario& scenario, double hog_distance_m, double stone_x_m, servo::Curl curl,
                          double spin_radps);

/// Where a stone let go so comes to rest, in e.
hw::sim::StoneTruth resting_place(const hw::sim::Scenario& scenario, double hog_distance_m, double stone_x_m,
                                  const servo::ShotOrder& order);

}  // namespace hogline::campaign
