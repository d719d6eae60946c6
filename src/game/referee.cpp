#include "src/game/referee.hpp"

#include <algorithm>

namespace hogline::game {

using hw::StrategistPhase;
using servo::side_of;

Referee::Referee(const servo::GameSetting& setting, const std::array<hw::Strategist*, servo::team_count>& strategists,
                 StoneThrower& thrower, GameListener& listener)
    : Referee(setting, servo::new_game(setting), strategists, thrower, listener) {}

Referee::Referee(const servo::GameSetting& setting, const servo::GameState& state,
                 const std::array<hw::Strategist*, servo::team_count>& strategists, StoneThrower& thrower,
                 GameListener& listener)
    : setting_(setting), strategists_(strategists), thrower_(thrower), listener_(listener) {
  update_.state = state;
}

void Referee::step(Stamp now) {
  if (phase_ == RefereePhase::over || phase_ == RefereePhase::stopped) return;
  for (auto* strategist : strategists_) strategist->step(now);
  // A stone that runs is followed to its end whatever happens to those who think.
  if (phase_ == RefereePhase::throwing) {
    if (const auto report = thrower_.step(now)) finish_throw(*report, now);
    return;
  }
  for (const auto* strategist : strategists_) {
    if (strategist->state().phase == StrategistPhase::failed) return stop(strategist->state().reason);
  }
  phase_ == RefereePhase::preparing ? prepare(now) : ask(now);
}

void Referee::prepare(Stamp now) {
  const auto ready = [](const auto* strategist) { return strategist->state().phase == StrategistPhase::ready; };
  if (!std::ranges::all_of(strategists_, ready)) return;
  const std::array<std::string, servo::team_count> names{strategists_[0]->state().name, strategists_[1]->state().name};
  for (auto* strategist : strategists_) strategist->begin(names, now);
  listener_.begun(names);
  tell(now);
}

void Referee::tell(Stamp now) {
  listener_.stands(update_);
  for (auto* strategist : strategists_) strategist->tell(update_, now);
  phase_ = update_.state.result ? RefereePhase::over : RefereePhase::asking;
}

void Referee::ask(Stamp now) {
  const Team team = *next_team(update_.state);
  const hw::StrategistState& state = strategists_[side_of(team)]->state();
  if (state.phase == StrategistPhase::late) {
    update_.state = servo::thought(update_.state, update_.state.thinking_left[side_of(team)]);
    update_.last.emplace().move = servo::Concession{};
    reason_ = state.reason;
    return tell(now);
  }
  if (state.phase != StrategistPhase::decided) return;
  turn_ = {team, next_stone(update_.state), update_.state.board, *state.decision};
  listener_.decided(turn_);
  update_.state = servo::thought(update_.state, turn_.decision.thought);
  if (std::holds_alternative<servo::Concession>(turn_.decision.move)) {
    update_.state = servo::conceded(update_.state);
    update_.last.emplace().move = turn_.decision.move;
    return tell(now);
  }
  thrower_.start(turn_, now);
  phase_ = RefereePhase::throwing;
}

void Referee::finish_throw(const ThrowReport& report, Stamp now) {
  if (report.end == ThrowEnd::failed) return stop("the throw failed: " + report.reason);
  const bool given_away = report.end == ThrowEnd::refused;
  const servo::ThrownStones seen = given_away ? servo::ThrownStones{.lying = turn_.board} : report.seen;
  const servo::Judged judged = judge(update_.state, seen, setting_);
  if (!judged.ok) return stop("what was seen of the throw can not be: " + judged.reason);
  listener_.thrown(turn_, report, judged);
  update_.state = judged.state;
  servo::LastMove& last = update_.last.emplace();
  last.move = turn_.decision.move;
  last.free_guard_zone_foul = judged.free_guard_zone_foul;
  if (report.trajectory) last.trajectory = report.trajectory;
  if (given_away) last.trajectory.emplace().start = turn_.board;  // no frames: nothing has moved
  if (last.trajectory) last.trajectory->finish = judged.board;
  tell(now);
}

void Referee::stop(const std::string& reason) {
  phase_ = RefereePhase::stopped;
  reason_ = reason;
  listener_.stopped(reason);
}

}  // namespace hogline::game
