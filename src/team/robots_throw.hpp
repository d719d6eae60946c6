// Adapter: the stone of a turn thrown and followed by two robots. The skip looks, the order goes over the link, the
// thrower throws, the skip follows and counts; what it saw is the board of the next turn.
//
// A throw that ends with the stone in the jaws is repeated, with the robot put back, twice at most; then the game
// stops. A stone that left the hack without having been let go as ordered is not thrown again: what lies afterwards
// counts.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "servo/ice_model.hpp"
#include "src/game/stone_thrower.hpp"
#include "src/team/simulated_team.hpp"
#include "src/throwing/throw_judge.hpp"

namespace hogline {

/// Where a stone that met nothing was to stop, by the release as the thrower told it and the ice as it was known then,
/// and where it lay. In s.
struct IceLesson {
  servo::StopPrediction foretold;
  servo::Place rest;
  servo::IceEstimate before;
  servo::IceEstimate after;
  double error_m() const;
};

/// All that there is to tell of one throw.
struct TurnRecord {
  game::Turn turn;
  game::ThrowReport report;
  int attempts = 0;
  std::vector<std::string> remarks;           ///< in their order
  std::vector<StoneSighting> before;          ///< in the skip's e, as looked at before the throw
  std::optional<hw::ReleaseMessage> release;  ///< as the thrower told it
  std::optional<servo::SkipReport> followed;
  std::optional<servo::StopPrediction> foretold;  ///< in the skip's e, the last one beyond the near hog line
  std::optional<std::vector<StoneSighting>> counted;
  servo::IceEstimate ice;  ///< afterwards
  std::optional<IceLesson> lesson;
  TrueThrow truth;                       ///< what no robot was told
  servo::Board true_before;              ///< where the stones lay
  ThrowResult thrower;                   ///< against the truth
  std::vector<servo::Place> robot_path;  ///< in truth, in the thrower's e; of the last attempt
  std::vector<servo::Place> stone_path;
  double simulated_s = 0.0;
  double wall_s = 0.0;
};

class RobotsThrow final : public game::StoneThrower {
 public:
  using Progress = std::function<void(double t_s, const std::string& what)>;

  /// The team must outlive it. `told` is given each throw's record when it has ended.
  RobotsThrow(SimulatedTeam& team, const servo::ThrowerSkill& skill, const servo::IceModel& ice,
              std::function<void(const TurnRecord&)> told, Progress progress = {});

  void start(const game::Turn& turn, Stamp now) override;
  /// A second of the rink's time at most.
  std::optional<game::ThrowReport> step(Stamp now) override;
  const servo::IceModel& ice() const { return ice_; }

 private:
  enum class Phase { idle, preparing, ordered, following, settling, counting };
  void enter(Phase phase, const std::string& what);
  std::optional<game::ThrowReport> advance();
  std::optional<game::ThrowReport> prepare_attempt();
  std::optional<game::ThrowReport> preparing();
  std::optional<game::ThrowReport> decide();
  std::optional<game::ThrowReport> ordered();
  std::optional<game::ThrowReport> failed(const std::string& why);
  void following();
  void settling();
  std::optional<game::ThrowReport> counting();
  game::ThrowReport ended();
  game::ThrowReport closed(game::ThrowEnd end, const std::string& reason);
  void learn();
  void watch_truth();
  void tell_state();
  void tell_stone();

  SimulatedTeam& team_;
  servo::ThrowerSkill skill_;
  servo::IceModel ice_;
  std::function<void(const TurnRecord&)> told_;
  Progress progress_;
  Phase phase_ = Phase::idle;
  Stamp since_{};
  Stamp began_{};
  std::uint32_t shot_ = 0;
  int periods_ = 0;
  std::string told_state_;
  Stamp stone_told_{};
  TurnRecord record_;
  std::vector<std::optional<StoneName>> names_;
  std::optional<ThrowJudge> judge_;
  std::chrono::steady_clock::time_point wall_began_{};
};

/// What a thrower of this rig can be relied on for, in s.
servo::ThrowerSkill skill_of(const config::ThrowerRig& rig);

}  // namespace hogline
