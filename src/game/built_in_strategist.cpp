#include "src/game/built_in_strategist.hpp"

#include <string>
#include <utility>

#include "servo/game/rules.hpp"

namespace hogline::game {

using hw::StrategistPhase;

BuiltInStrategist::BuiltInStrategist(Team team, const servo::ThrowerSkill& skill, std::function<servo::IceModel()> ice)
    : team_(team), skill_(skill), ice_(std::move(ice)) {
  state_.phase = StrategistPhase::ready;
  state_.name = "hogline";
}

void BuiltInStrategist::begin(const std::array<std::string, servo::team_count>&, Stamp) {
  state_.phase = StrategistPhase::waiting;
}

void BuiltInStrategist::tell(const servo::GameUpdate& update, Stamp) {
  const auto next = servo::next_team(update.state);
  state_.decision.reset();
  state_.phase = !next ? StrategistPhase::over : StrategistPhase::waiting;
  if (next != team_) return;
  const servo::SmallAnswer answer = servo::small_strategy(update.state, skill_, ice_());
  if (!answer.ok) {
    state_.phase = StrategistPhase::failed;
    state_.reason = "the built-in strategist knows no shot: " + answer.reason;
    return;
  }
  state_.phase = StrategistPhase::decided;
  state_.decision = hw::StrategistDecision{.move = answer.told,
                                           .order = answer.order,
                                           .thought = Duration::zero(),
                                           .plan = std::string(name_of(answer.plan))};
}

}  // namespace hogline::game
