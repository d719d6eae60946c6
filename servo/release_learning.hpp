// What letting go is like with this gripper, learnt from throw to throw: how long it takes, and what speed it costs.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "servo/thrower_config.hpp"

namespace hogline::servo {

struct ReleaseKnowledge {
  double delay_s = 0.0;                ///< from the order to the stone being free
  double drag_mps = 0.0;               ///< by so much the stone is slower than the body that let it go
  std::array<double, 4> covariance{};  ///< of (delay, drag), row by row
  int throws = 0;                      ///< it rests on
};

/// What one throw told. What was not measured is empty.
struct ReleaseFeedback {
  std::optional<double> delay_s;  ///< by the jaws' own report of their travel
  double delay_sigma_s = 0.0;
  std::optional<double> drag_mps;  ///< the body's speed when the stone was free less the stone's, as tracked afterwards
  double drag_sigma_mps = 0.0;
};

struct ReleaseLesson {
  ReleaseKnowledge knowledge;
  std::string refused;  ///< what was not believed, and why; empty when all was
};

/// What the rig file says: the maker's or a caliper's word, with its sigmas.
ReleaseKnowledge prior_of(const ReleaseConfig& config);

/// Kalman update after one throw; between throws jaws wear, and both may drift a little. Feedback that is not finite,
/// has no positive sigma, or lies further than five sigmas off is refused, and only the drift is added.
ReleaseLesson learn(const ReleaseKnowledge& knowledge, const ReleaseFeedback& feedback);

/// What trials on the standing stone tell of the delay. `jitter_s`: by which one delay differs from the next. Refused,
/// and nothing learnt, where one of them is not believable.
ReleaseLesson learn_rehearsed(const ReleaseKnowledge& knowledge, const std::vector<double>& delays_s, double jitter_s);

/// The configuration with what was learnt in the rig's place.
ReleaseConfig with_knowledge(ReleaseConfig config, const ReleaseKnowledge& knowledge);

}  // namespace hogline::servo
