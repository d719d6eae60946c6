// A shot as Digital Curling gives it, and what else a team may do in its turn.
#pragma once

#include <variant>

#include "servo/shot.hpp"

namespace hogline::servo {

/// The state of a stone at the hack, (0, 0) of frame s, from where it slides freely by FCV1; it turns by a quarter turn
/// a second. No robot throws that: see servo/shot_mapping.
struct HackShot {
  double vx_mps = 0.0;
  double vy_mps = 0.0;
  Curl curl = Curl::counter_clockwise;
};

struct Concession {};

using GameMove = std::variant<HackShot, Concession>;

}  // namespace hogline::servo
