// Is it a stone? What a fit of handle and granite must look like to be believed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vision/detect/stone_team.hpp"
#include "vision/detect/stone_vote.hpp"
#include "vision/fit/stone_fit.hpp"

namespace hogline::vision {

/// A candidate and how it came out of its fit.
struct JudgedStone {
  StoneCandidate candidate;
  FittedStone fit;
  std::string doubt;                      ///< empty: a stone; else why it is none
  bool glimpsed = false;                  ///< judged with the club's granite known
  std::optional<Foreground> before = {};  ///< what somebody hides of it, where it was left out
  bool moved_alone = false;  ///< found off its votes, and there was no other stone to learn the granite from
};

/// Why a fitted candidate is no stone, by itself: its "granite" is not grey or too dark or too light, its "handle" is
/// of the same colour, the picture is not explained, it ran away from its votes. Empty where there is no doubt.
/// `behind_another`: a nearer stone may hide its body, which then need not be seen.
std::string doubt_of(const StoneCandidate& candidate, const FittedStone& fit, bool behind_another);

/// What may keep a part of a stone from being seen.
enum class InTheWay {
  nothing,
  others,         ///< nearer stones, or whoever was seen to go on beyond its outline
  what_it_is_not  ///< all that was not like a stone was left out: what is left must be more like one
};

InTheWay in_the_way_of(const std::optional<Foreground>& before, bool behind_another);

/// The same of what was fitted with the club's granite known: parts may be hidden, what is left must be a stone's.
std::string doubt_of_glimpse(const StoneCandidate& candidate, const FittedStone& fit, const Light& granite,
                             InTheWay in_the_way);

/// Paint may look like that, or somebody: a clear grip must be seen to believe it.
bool is_dubious(const JudgedStone& stone);

/// The middle one of what the believed stones show of it, channel by channel; nothing where none does.
std::optional<Light> clubs_granite(const std::vector<JudgedStone>& stones);

/// The granite's colour at the place of the votes alone says that no fit will make a stone of it.
bool is_hopeless(const Light& granite);

/// A handle's light is no grey: it is clearly of some colour.
bool has_a_colour(const Light& handle);

/// Nearer than two stones can stand, even if they were a pixel farther apart along the line of sight: 7 cm far away.
bool stand_in_one_place(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const StonePicture& picture);

/// The doubt of what a better one leaves no room for.
inline constexpr const char* no_room = "another stone stands there";

/// Of those that stand in one place the better keeps it. Marks the others.
void part_overlapping(const StonePicture& picture, std::vector<JudgedStone>& stones);

/// What shows no granite and stands where a nearer stone's grip is seen may be that grip: marks it. `eye` in e.
void doubt_grips(std::vector<JudgedStone>& stones, const Eigen::Vector3d& eye, const StoneShape& shape);

/// All stones of a club are cut from the same rock: marks what differs much from the others' granite.
void compare_granite(std::vector<JudgedStone>& stones);

/// What the verdict leaves of a stone, as the percept says it.
StoneSighting sighting_of(const JudgedStone& stone, const TeamHues& teams);

}  // namespace hogline::vision
