// A curling stone that slides by itself: FCV1, the model of the Digital Curling simulator.
#pragma once

#include "hw/sim/scenario.hpp"
#include "hw/sim/truth.hpp"

namespace hogline::hw::sim {

/// Moves the stone by dt_s, a step of the order of a millisecond. With v its speed and w its rate of turn (FCV1):
/// deceleration g (0.00200985 / (v + 0.06385782) + 0.00626286), turn of the heading sign(w) 0.00820 v^-0.8 rad/s,
/// d|w|/dt = -0.025 / max(v, 0.001) rad/s2; each scaled by the scenario. Counter-clockwise curls left.
/// The friction grows with the distance from the centre line by `lane_friction`.
void slide(StoneTruth& stone, const StoneScenario& scenario, double dt_s);

/// A stone that moves or turns.
bool moves(const StoneTruth& stone);

/// Two stones that touch and approach each other part, in no time: Newton's restitution along the line between them,
/// Coulomb's friction across it, at most what stops their rims' sliding. Conserves momentum and angular momentum.
/// Returns whether they did.
bool collide(StoneTruth& a, StoneTruth& b, const StoneScenario& scenario);

}  // namespace hogline::hw::sim
