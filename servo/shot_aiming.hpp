// Which release brings a stone to a wanted place on this ice, to rest there or to hit with a wanted speed: speed,
// heading and sense of spin. Frame s throughout.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "servo/ice_model.hpp"
#include "servo/place.hpp"
#include "servo/shot.hpp"

namespace hogline::servo {

/// What the thrower can do: where it lets go, how fast it may be, how true it is.
struct ThrowerSkill {
  Place release;  ///< of the stone's centre
  double max_speed_mps = 0.0;
  double spin_radps = 0.0;  ///< magnitude at release
  double speed_sigma_mps = 0.0;
  double heading_sigma_rad = 0.0;
  /// Every shot's line runs through the middle of the hack, s's origin, and the stone is let go on it at release.y;
  /// else at `release`, whatever its heading.
  bool line_through_hack = false;
};

/// Where the stone of a shot with this heading is let go.
Place release_place(const ThrowerSkill& skill, double heading_rad);

struct ShotWish {
  Place rest;                   ///< where the stone shall stop
  std::optional<Curl> curl{};   ///< empty: the sense that keeps clearer of the stones, or is the surer of the two
  std::vector<Place> stones{};  ///< that stand on the sheet
};

struct ShotAim {
  bool ok = false;
  std::string reason;          ///< why not, when !ok
  ShotOrder order;             ///< heading from s's y axis, which is e's of the thrower
  Place rest;                  ///< as predicted, within a millimetre of the wish
  PlaceCovariance covariance;  ///< of where it will stop: ice, its scatter from throw to throw, and the thrower
  double clearance_m = 0.0;    ///< least gap between the running stone and one that stands; large without any
};

/// A stone that shall pass a place with a speed: a hit, seen from where the thrown stone's centre is at the contact.
struct HitWish {
  Place contact;
  double speed_mps = 0.0;
  std::optional<Curl> curl{};
  std::vector<Place> stones{};  ///< that stand on the way to it; not the one that is to be hit
};

struct HitAim {
  bool ok = false;
  std::string reason;
  ShotOrder order;
  double speed_mps = 0.0;        ///< at the contact, as predicted
  double heading_rad = 0.0;      ///< of the velocity there, from s's y axis
  double aside_sigma_m = 0.0;    ///< of x where it crosses the contact's y: ice, throw and thrower
  double speed_sigma_mps = 0.0;  ///< there
  double clearance_m = 0.0;
};

/// Refused as aim_shot() refuses.
HitAim aim_hit(const HitWish& wish, const ThrowerSkill& skill, const IceModel& ice);

/// The stone at the moment it is let go as ordered.
SlidingStone released(const ShotOrder& order, const Place& release);

/// A way that touches a stone before its end is refused ("the way is not free"), one beyond the thrower's speed too.
ShotAim aim_shot(const ShotWish& wish, const ThrowerSkill& skill, const IceModel& ice);

}  // namespace hogline::servo
