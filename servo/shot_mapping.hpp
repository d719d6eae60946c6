// From a shot of Digital Curling to one that a robot can throw on its own ice: what the shot was meant to come to by
// FCV1 with these stones, and the release that comes to the same by the ice model. Frame s throughout.
//
// Of a hit the place and the speed of the first contact are the same; the direction of travel there follows from the
// other ice and release, and differs by as much as is stated. The way before the contact is another one too.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "servo/game/hack_shot.hpp"
#include "servo/place.hpp"
#include "servo/shot_aiming.hpp"

namespace hogline::servo {

enum class Intent {
  rest,   ///< touches nothing and comes to rest on the sheet
  touch,  ///< touches a stone
  leave,  ///< passes the back line, or touches a sideline, without having touched a stone
};

/// What a shot comes to: the stone where it rests, first touches, or leaves play.
struct IntendedOutcome {
  Intent intent = Intent::rest;
  Place place;               ///< of its centre
  double speed_mps = 0.0;    ///< there; 0 of a rest
  double heading_rad = 0.0;  ///< of its velocity there, from s's y axis, counter-clockwise positive; 0 of a rest
  std::size_t stone = 0;     ///< which it touches, of a touch
};

/// The stones that stand, and how wide the sheet is (empty: no sidelines).
struct Surroundings {
  std::vector<Place> stones;
  std::optional<double> sheet_width_m;
};

/// By FCV1. Preconditions: finite, vy_mps > 0.
IntendedOutcome intended_outcome(const HackShot& shot, const Surroundings& around);

/// The shot of Digital Curling that comes to that by FCV1 where no stone is in its way; nothing when there is none.
/// The contact's heading is what follows.
std::optional<HackShot> hack_shot_for(const IntendedOutcome& outcome, Curl curl);

struct MappedShot {
  bool ok = false;
  std::string reason;        ///< why not, when !ok
  IntendedOutcome intended;  ///< valid unless the shot itself was refused
  IntendedOutcome expected;  ///< of `order`, by the ice model with the same stones
  ShotOrder order;
  double off_m = 0.0;            ///< how far the expected place is from the intended one
  double off_heading_rad = 0.0;  ///< expected less intended direction of travel there
  double sigma_m = 0.0;          ///< one sigma of the place: of a rest in any direction, else across the way
};

/// Refused: a shot that does not go down-ice or is faster than any stone (10 m/s), one that the thrower or the ice do
/// not allow, and one whose way on this ice meets another stone first.
MappedShot map_shot(const HackShot& shot, const Surroundings& around, const ThrowerSkill& skill, const IceModel& ice);

}  // namespace hogline::servo
