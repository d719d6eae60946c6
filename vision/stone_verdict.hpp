// Is it a stone? What a fit of handle and granite must look like to be believed.
#pragma once

#include <string>
#include <vector>

#include "vision/detect/stone_vote.hpp"
#include "vision/fit/stone_fit.hpp"

namespace hogline::vision {

/// A candidate and how it came out of its fit.
struct JudgedStone {
  StoneCandidate candidate;
  FittedStone fit;
  std::string doubt;  ///< empty: a stone; else why it is none
};

/// Why a fitted candidate is no stone, by itself: its "granite" is not grey or too dark or too light, its "handle" is
/// of the same colour, the picture is not explained, it ran away from its votes. Empty where there is no doubt.
/// `behind_another`: a nearer stone may hide its body, which then need not be seen.
std::string doubt_of(const StoneCandidate& candidate, const FittedStone& fit, bool behind_another);

/// The granite's colour at the place of the votes alone says that no fit will make a stone of it.
bool is_hopeless(const Light& granite);

/// Two stones can not stand in one place: of those nearer than a stone's breadth the better keeps it. Marks the others.
void part_overlapping(std::vector<JudgedStone>& stones);

/// What shows no granite and stands where a nearer stone's grip is seen may be that grip: marks it. `eye` in e.
void doubt_grips(std::vector<JudgedStone>& stones, const Eigen::Vector3d& eye, const StoneShape& shape);

/// All stones of a club are cut from the same rock: marks what differs much from the others' granite.
void compare_granite(std::vector<JudgedStone>& stones);

}  // namespace hogline::vision
