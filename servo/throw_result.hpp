// What a throw came to, in numbers that curlers and the ice model use. Frame e of the skip.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "servo/stone_rotation.hpp"
#include "servo/stone_world.hpp"
#include "servo/throw_fit.hpp"

namespace hogline::servo {

/// A number with one standard deviation, both in the unit of its name's ending.
struct Measured {
  double value = 0.0;
  double sigma = 0.0;
};

/// The thrown stone at one look, smoothed by all looks.
struct TrajectoryPoint {
  Stamp stamp{};
  double x_m = 0.0;
  double y_m = 0.0;
  PlaceCovariance covariance;
};

enum class StoneFate {
  at_rest,   ///< in play
  hogged,    ///< the thrown one, short of the hog line, without having hit a stone
  sideline,  ///< touched a sideline
  through,   ///< passed the back line
  lost,      ///< was still running when it was seen last
};

struct StoneOutcome {
  int id = 0;
  Team team = Team::unknown;
  bool thrown = false;
  bool moved = false;
  StoneFate fate = StoneFate::at_rest;
  bool certain = true;  ///< no margin that decides it is smaller than two sigmas
  double x_m = 0.0;     ///< where it rests, or was last
  double y_m = 0.0;
  PlaceCovariance covariance;
};

struct ThrowResult {
  bool ok = false;
  std::string reason;                       ///< why not, when !ok: no stone was seen to be thrown
  std::vector<TrajectoryPoint> trajectory;  ///< up to the first collision
  ThrowFit fit;                             ///< its own ok: what the times and the curl rest upon
  std::optional<ThrowTrack> track;        ///< for the ice model (servo/skip_sheet: from_other_end); empty: the sense of
                                          ///< spin is not known, or the fit is not ok
  std::optional<Measured> hog_to_hog_s;   ///< centre from house-side edge to house-side edge
  std::optional<Measured> hog_to_rest_s;  ///< of a throw that hit nothing
  std::optional<Measured>
      curl_m;  ///< from its direction at the first hog line to the end of the trajectory, left positive
  StoneRotation rotation;
  std::vector<WorldCollision> collisions;  ///< in their order; what moved no stone measurably is none
  std::vector<StoneOutcome> stones;        ///< all, by their identities
};

/// `spin_radps`: what was ordered, 0 when not known; the handle's is preferred where it was measured.
ThrowResult result_of(const World& world, double spin_radps, const WorldConfig& config, const ThrowFitConfig& fit);

}  // namespace hogline::servo
