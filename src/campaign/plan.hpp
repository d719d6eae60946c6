// What a campaign throws: everything that decides its rows, and nothing that does not.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/campaign/span.hpp"
#include "src/config/scenario.hpp"
#include "src/throwing/simulated_throw.hpp"

namespace hogline::campaign {

/// Which way the stones turn.
enum class Turn { clockwise, counter_clockwise, both };
std::string_view to_string(Turn turn);

/// An ingredient that a campaign leaves out, to show what it buys.
enum class Without {
  nothing,
  refraction,        ///< vision takes the paint to lie on the surface; rendered pictures only
  latency,           ///< what was seen is taken for the present
  tracking,          ///< plain vpMeLine in the low view; rendered pictures only
  visual_alignment,  ///< one look at the start, then the turn by the gyro alone
};
std::string_view to_string(Without without);
/// Nothing when it is none of the words of to_string().
std::optional<Without> parse_without(std::string_view word);

/// The words of a plan, as they stand on the command line and in the campaign's folder.
struct PlanText {
  std::string rig;       ///< the content of the file
  std::string scenario;  ///< the content of the file
  std::uint64_t seed = 0;
  Eyes eyes = Eyes::oracle;
  Span speed_mps;
  Span heading_deg;
  Span spin_radps;
  Turn turn = Turn::both;
  bool tee_draws = false;  ///< speed and heading are solved for the far tee on the scenario's ice
  Without without = Without::nothing;
};

/// What is drawn for one throw.
struct Draw {
  int number = 0;          ///< from 0
  std::uint64_t seed = 0;  ///< of the scenario and all that is random in the throw; below 10^18
  servo::ShotOrder order;
};

/// Each throw belongs to its number: it is the same whoever throws it, after whatever others.
class Plan {
 public:
  /// Throws ConfigError: a rig or scenario that is wrong, a shot that the rig can not make.
  explicit Plan(PlanText text);

  const PlanText& text() const { return text_; }
  const config::ThrowerRig& rig() const { return rig_; }
  Draw draw(int number) const;
  ThrowRequest request(const Draw& draw) const;

 private:
  PlanText text_;
  config::ThrowerRig rig_;  ///< without what is left out
  config::ScenarioFile scenario_;
};

}  // namespace hogline::campaign
