// Every throw judged twice: by what the skip saw, and by where the stones lie in truth. For games on the simulated
// rink, where both are known.
#pragma once

#include <string>
#include <vector>

#include "src/game/referee.hpp"
#include "src/team/robots_throw.hpp"

namespace hogline {

/// The rules say one thing of what was seen and another of the truth.
struct Disagreement {
  int end = 0;
  int shot = 0;
  std::string what;
  double margin_m = 0.0;   ///< by which truth decides it
  bool a_measure = false;  ///< by less than the skip can see: on ice somebody would measure
};

struct TruthFigures {
  int throws = 0;
  int given_away = 0;
  int repeated = 0;    ///< attempts beyond the first
  int unfollowed = 0;  ///< throws with a remark of the skip's
  int ends = 0;
  int measures = 0;        ///< ends that truth decides by less than can be seen
  double square_m2 = 0.0;  ///< of stones' places, seen less true
  int places = 0;
  double worst_m = 0.0;
  int collisions = 0;  ///< throws that struck a stone in truth
  int struck_wrong = 0;
  std::vector<Disagreement> disagreements;
};

/// What the rules make of a throw is told to another listener unchanged.
class TruthCheck final : public game::GameListener {
 public:
  TruthCheck(const servo::GameSetting& setting, game::GameListener& next);

  /// Before the throw is judged.
  void record(const TurnRecord& record) { record_ = record; }
  const TruthFigures& figures() const { return figures_; }

  void begun(const std::array<std::string, servo::team_count>& names) override { next_.begun(names); }
  void stands(const servo::GameUpdate& update) override;
  void decided(const game::Turn& turn) override { next_.decided(turn); }
  void thrown(const game::Turn& turn, const game::ThrowReport& report, const servo::Judged& judged) override;
  void stopped(const std::string& reason) override { next_.stopped(reason); }

 private:
  void compare(const servo::Judged& seen);
  void places(const servo::Board& seen, const servo::Board& truth);
  void disagree(const std::string& what, double margin_m);

  servo::GameSetting setting_;
  game::GameListener& next_;
  servo::GameState before_;
  TurnRecord record_;
  TruthFigures figures_;
};

}  // namespace hogline
