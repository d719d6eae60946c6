// Adapter: the small strategist, which answers at once.
#pragma once

#include <functional>

#include "hw/strategist.hpp"
#include "servo/small_strategy.hpp"

namespace hogline::game {

class BuiltInStrategist final : public hw::Strategist {
 public:
  /// The ice as it is known at the moment of the question.
  BuiltInStrategist(Team team, const servo::ThrowerSkill& skill, std::function<servo::IceModel()> ice);

  void begin(const std::array<std::string, servo::team_count>&, Stamp) override;
  void tell(const servo::GameUpdate& update, Stamp now) override;
  void step(Stamp) override {}
  const hw::StrategistState& state() const override { return state_; }

 private:
  Team team_;
  servo::ThrowerSkill skill_;
  std::function<servo::IceModel()> ice_;
  hw::StrategistState state_;
};

}  // namespace hogline::game
