// The stones of a game, thrown by the robots that stay: as RobotsThrow has it for the simulated team. The skip looks,
// the thrower's operator arms, the shot is ordered, followed to its rest and counted. Used by the thread of the game;
// the skip is asked through its control loop.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "src/game/stone_thrower.hpp"
#include "src/live/live_skip.hpp"
#include "src/live/loop_calls.hpp"
#include "src/team/stone_names.hpp"

namespace hogline {

/// A throw that was given up with the stone kept is begun again when its operator arms the thrower anew, twice at most.
class LiveThrows final : public game::StoneThrower {
 public:
  using Tell = std::function<void(const char* event, const std::string& what)>;

  /// Skip and calls must outlive it.
  LiveThrows(LiveSkip& skip, LoopCalls& calls, const servo::ThrowerSkill& skill, const servo::IceModel& ice, Tell tell);

  void start(const game::Turn& turn, Stamp now) override;
  std::optional<game::ThrowReport> step(Stamp now) override;
  /// A throw for which nothing has been ordered yet, or nothing is on its way any more, is not begun (again): it has
  /// failed with this reason. Any other goes on to its end.
  void cancel(const std::string& reason);
  const servo::IceModel& ice() const { return ice_; }

 private:
  enum class Phase { idle, preparing, ordered, following, settling, counting };
  std::optional<game::ThrowReport> prepare(Stamp now);
  std::optional<game::ThrowReport> preparing(const SkipView& view, Stamp now);
  std::optional<game::ThrowReport> look_again(const std::string& why, Stamp now);
  std::optional<game::ThrowReport> order(const SkipView& view, Stamp now);
  std::optional<game::ThrowReport> ordered(const SkipView& view, Stamp now);
  std::optional<game::ThrowReport> released(Stamp now);
  std::optional<game::ThrowReport> not_thrown(const std::string& why, Stamp now);
  std::optional<game::ThrowReport> counting(const SkipView& view, Stamp now);
  game::ThrowReport ended(const SkipView& view);
  void learn(const servo::ThrownStones& seen);
  game::ThrowReport closed(game::ThrowEnd end, const std::string& reason);
  void begin_again(const std::string& why, Stamp now);
  void begin_look(Phase phase, Stamp now);

  LiveSkip& skip_;
  LoopCalls& calls_;
  servo::ThrowerSkill skill_;
  servo::IceModel ice_;
  Tell tell_;
  Phase phase_ = Phase::idle;
  Stamp since_{};
  Stamp settled_{};
  std::optional<Stamp> lost_since_;  ///< head or cameras, before anything was ordered
  int attempts_ = 0;
  std::string cancelled_;
  std::string not_begun_;
  std::uint32_t shot_ = 0;
  game::Turn turn_;
  game::ThrowReport report_;
  std::vector<std::optional<StoneName>> names_;
  std::optional<servo::SkipReport> followed_;
};

}  // namespace hogline
