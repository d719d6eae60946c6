// One account of what happened on the sheet: every stone, how it moves, which have met. The collision watch keeps
// several such accounts while it is not yet clear whether, and how fully, a stone was hit, and drops those that the
// looks contradict. Frame e of the skip.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "servo/stone_impact.hpp"
#include "servo/thrown_stone_filter.hpp"
#include "vision/percepts/stones.hpp"

namespace hogline::servo {

/// A look at some stone, with what tells whose it is.
struct StoneLook {
  TrackLook look;
  Team team = Team::unknown;
  std::optional<double> handle_rad;
  double handle_sigma_rad = 0.1;
};

/// A stone's looks, the newest first; accounts share them.
struct SeenLook {
  StoneLook seen;
  std::shared_ptr<const SeenLook> before;
};

enum class StonePhase {
  standing,
  moving,
  gone,  ///< out of play: touched a sideline, or passed the back line
};

struct WorldStone {
  int id = 0;
  Team team = Team::unknown;
  StonePhase phase = StonePhase::standing;
  StoneMotion motion;
  bool thrown = false;
  bool has_moved = false;
  std::shared_ptr<const SeenLook> looks;  ///< since it moves; none of a stone that never did
  Stamp last_seen{};
  int looks_at_rest = 0;  ///< in a row while the motion was at rest
  std::optional<Stamp> resting_since;
  double side_margin_m = 1e9;  ///< least so far to touching a sideline; negative: it did
  double side_sigma_m = 0.0;   ///< of that
  double back_margin_m = 1e9;  ///< least so far to lying wholly behind the back line
  double back_sigma_m = 0.0;
};

struct WorldCollision {
  Stamp stamp{};
  int striker = 0;
  int struck = 0;
  double x_m = 0.0;  ///< between the two centres
  double y_m = 0.0;
  double struck_x_m = 0.0;  ///< where the struck stone was
  double struck_y_m = 0.0;
};

struct WorldConfig {
  MotionNoise noise;
  ImpactConfig impact;
  IceEstimate ice;  ///< in e of the skip
  double throw_friction_sigma = 0.005;
  double expected_spin_radps = 0.0;     ///< of a thrown stone that is first seen running; 0: may curl either way
  std::optional<double> sheet_width_m;  ///< between the sidelines; nothing where there are none to touch
  double seen_share = 0.8;              ///< of its looks in which a stone in view is found
  double clutter_per_m2 = 1e-3;         ///< density of looks that are of no stone
  double other_team_share = 0.01;       ///< of looks that take a stone for the other team's
};

struct World {
  Stamp stamp{};
  std::vector<WorldStone> stones;
  std::vector<WorldCollision> collisions;
  std::vector<std::pair<int, int>> settled;  ///< pairs whose meeting has been judged, until they are apart
  std::vector<StoneLook> strays;             ///< of the last second, by their stamps, of no known stone
  double log_likelihood = 0.0;
  int looks_since_split = 0;  ///< pictures with a running stone in them

  /// Nothing when there is none of this identity.
  const WorldStone* find(int id) const;
  const WorldStone* thrown() const;
};

/// All accounts into which one may split on the way to `to`: at every meeting one in which the two pass each other and
/// some in which they touch.
std::vector<World> advanced(const World& world, Stamp to, const WorldConfig& config);

/// Notes how near a moving stone is to a sideline and to the back line, and that it is gone when it is over one of
/// them.
void judge_margins(WorldStone& stone, const WorldConfig& config);

/// Takes in the looks of one picture. Precondition: the world is at their stamp.
void take(World& world, const std::vector<StoneLook>& looks, const WorldConfig& config);

}  // namespace hogline::servo
