// From candidates to stones: first each by itself, then what hides behind others or behind somebody's legs, by what the
// first ones have shown of the club's stones.
#pragma once

#include <optional>
#include <vector>

#include "vision/detect/handle_search.hpp"
#include "vision/detect/stone_team.hpp"
#include "vision/detect/stone_vote.hpp"
#include "vision/fit/stone_fit.hpp"
#include "vision/stone_looks.hpp"
#include "vision/stone_verdict.hpp"

namespace hogline::vision {

class CrowdScreening {
 public:
  explicit CrowdScreening(const TeamHues& teams) : teams_(teams) {}

  /// Each candidate by itself: what is no stone does not look like one in any light.
  std::vector<JudgedStone> look(const StonePicture& picture, const std::vector<StoneCandidate>& candidates);

  /// Two that came out nearer than two stones can stand are fitted together: both stay if that parts them.
  void tell_apart(const StonePicture& picture, std::vector<JudgedStone>& stones);

  /// Once the granite is known: what was doubted, and handles that show behind known stones, with the parts that stones
  /// and legs hide left out. `stones` grows.
  void look_again(const StonePicture& picture, std::vector<JudgedStone>& stones);

  /// Of that only handles that show behind known stones: for views in which a doubt is seldom undone.
  void look_behind(const StonePicture& picture, std::vector<JudgedStone>& stones);

  /// Stones that are not well told are fitted again from several places, with all the others known.
  void place_again(const StonePicture& picture, std::vector<JudgedStone>& stones);

  /// The same of these candidates alone.
  void look_at(const StonePicture& picture, const std::vector<StoneCandidate>& candidates,
               std::vector<JudgedStone>& stones);

 private:
  std::vector<StoneCandidate> worth_another_look(const StonePicture& picture, const std::vector<JudgedStone>& stones,
                                                 const Light& granite) const;
  bool may_be_half_hidden(const StonePicture& picture, const Eigen::Vector2d& place, const Light& granite) const;
  bool looks_like_a_handle(const StonePicture& picture, const Eigen::Vector2d& place) const;
  void glimpse_round_by_round(const StonePicture& picture, const std::vector<StoneCandidate>& doubted,
                              const Light& granite, std::vector<JudgedStone>& stones);
  void look_alone(const StonePicture& picture, std::vector<JudgedStone>& stones);
  void glimpse_all(const StonePicture& picture, const std::vector<StoneCandidate>& candidates, const Light& granite,
                   std::vector<JudgedStone>& stones);
  JudgedStone glimpse(const StonePicture& picture, const StoneCandidate& candidate,
                      const std::vector<KnownStone>& known, const Light& granite);

  JudgedStone glimpse_from_starts(const StonePicture& picture, const StoneCandidate& candidate,
                                  const std::vector<KnownStone>& known, const Light& granite,
                                  const std::optional<Foreground>& before);

  TeamHues teams_;
  HandleSearch handles_;
  StoneFitter fitter_;
};

}  // namespace hogline::vision
