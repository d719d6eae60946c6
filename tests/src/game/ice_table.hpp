// A sheet, a thrower and a game as the tests play it.
#pragma once

#include <numbers>
#include <vector>

#include "src/game/referee.hpp"
#include "src/game/simulated_throws.hpp"

namespace hogline::game::test {

using namespace std::chrono_literals;

inline servo::GameSetting setting_of(int ends) {
  servo::GameSetting setting;
  setting.ends = ends;
  setting.thinking = {600s, 600s};
  setting.extra_thinking = {60s, 60s};
  return setting;
}

inline servo::ThrowerSkill robot() {
  return {.release = {0.0, 9.159},
          .max_speed_mps = 3.4,
          .spin_radps = 1.57,
          .speed_sigma_mps = 0.006,
          .heading_sigma_rad = 0.03 * std::numbers::pi / 180.0};
}

/// FCV1 itself, and a thrower and an ice model without a fault: shots come to what they were meant to.
inline SimulatedThrows exact_throws() {
  servo::ThrowerSkill skill = robot();
  skill.speed_sigma_mps = skill.heading_sigma_rad = 0.0;
  const SimulatedSheet sheet{{}, 1.0, 0.2, 0.0, 4.75};
  const servo::IceModel ice({}, {1.0, 1.0, 0.0, {1e-6, 0, 0, 0, 1e-6, 0, 0, 0, 1e-12}, 9});
  return SimulatedThrows(sheet, skill, ice, 1);
}

/// Keeps all that happened.
class Witness : public GameListener {
 public:
  void begun(const std::array<std::string, servo::team_count>& teams) override { names = teams; }
  void stands(const servo::GameUpdate& update) override { updates.push_back(update.state); }
  void decided(const Turn& turn) override { turns.push_back(turn); }
  void thrown(const Turn&, const ThrowReport& report, const servo::Judged& judged) override {
    reports.push_back(report);
    judgements.push_back(judged);
  }
  void stopped(const std::string& reason) override { stops.push_back(reason); }

  std::array<std::string, servo::team_count> names;
  std::vector<servo::GameState> updates;
  std::vector<Turn> turns;
  std::vector<ThrowReport> reports;
  std::vector<servo::Judged> judgements;
  std::vector<std::string> stops;
};

}  // namespace hogline::game::test
