// Two stones that meet: whether and when, and with what they part.
//
// Equal discs (World Curling: radius 0.145 m at most). The impulse along the line of centres is (1 + e) / 2 of the
// closing speed; friction between the stones adds up to a share of it across. How full the hit was is known only as
// well as the two places are: each impact stands for a part of what is possible.
#pragma once

#include <optional>
#include <vector>

#include "servo/thrown_stone_filter.hpp"

namespace hogline::servo {

inline constexpr double stone_radius_m = 0.145;

struct ImpactConfig {
  double restitution = 0.88;  ///< simulators draw 0.80-0.95; no measurement is published
  double restitution_sigma = 0.05;
  double friction = 0.1;  ///< between the stones, 0.05-0.2
  double friction_sigma = 0.07;
  double least_velocity_sigma_mps = 0.03;  ///< of either stone afterwards: spins, pebble
  int most_parts = 5;                      ///< into which the fullness of a hit is cut
};

/// One way in which the two may have parted. Both motions are at the stamp at which they were handed over.
struct Impact {
  double probability = 0.0;
  StoneMotion striker;
  StoneMotion struck;
};

struct Meeting {
  double after_s = 0.0;  ///< until they touch, or are nearest
  double hit = 0.0;      ///< probability that they touch at all
};

/// Nothing when the two part, or will pass each other for certain. Straight on with their present velocities: look
/// ahead by a few hundredths of a second at most. Precondition: same stamps.
std::optional<Meeting> meeting(const StoneMotion& striker, const StoneMotion& struck);

/// The ways to part, their probabilities adding up to 1 given that the two touch. Precondition: meeting() has a value.
std::vector<Impact> impacts(const StoneMotion& striker, const StoneMotion& struck, const ImpactConfig& config);

}  // namespace hogline::servo
