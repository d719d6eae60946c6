// Steps that all who screen stones share: each by itself, and all together.
#pragma once

#include <vector>

#include "vision/detect/known_stone.hpp"
#include "vision/detect/stone_picture.hpp"
#include "vision/detect/stone_team.hpp"
#include "vision/detect/stone_vote.hpp"
#include "vision/fit/stone_fit.hpp"
#include "vision/stone_verdict.hpp"

namespace hogline::vision {

inline constexpr double stones_hide_m = 1.2;  ///< of the near view: a stone farther behind another is seen over it

/// A believed stone stands there already.
bool is_taken(const Eigen::Vector2d& place, const std::vector<JudgedStone>& stones);

/// Something nearer than `place` is among the stones, and may hide parts of it. `eye` on the ice, in e.
bool may_be_hidden(const Eigen::Vector2d& place, const std::vector<KnownStone>& others, const Eigen::Vector2d& eye,
                   double hiding_m = stones_hide_m);

/// Those without doubt.
std::vector<KnownStone> believed(const std::vector<JudgedStone>& stones);

/// Each candidate by itself, where no believed one stands: what is no stone does not look like one in any light.
std::vector<JudgedStone> look_at_each(const StonePicture& picture, const std::vector<StoneCandidate>& candidates,
                                      const StoneFitOptions& options, StoneFitter& fitter);

/// All of them together, for they hide each other and share a shape; judged again, each as it was judged before.
/// Returns the shape.
SharedLook fit_together(const StonePicture& picture, const StoneFitOptions& options,
                        const std::vector<JudgedStone*>& stones, StoneFitter& fitter, double hiding_m = stones_hide_m);

/// How much of a grip must be in sight to believe the stone, of one in plain sight.
double least_grip_of(const JudgedStone& stone);

/// So much is, as far as that can be told, with nothing known of other stones.
bool has_its_grip(const StonePicture& picture, const JudgedStone& stone, const TeamHues& teams);

/// Pointers to those without doubt.
std::vector<JudgedStone*> without_doubt(std::vector<JudgedStone>& stones);

}  // namespace hogline::vision
