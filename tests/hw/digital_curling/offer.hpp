// A game as the tests offer it.
#pragma once

#include "hw/digital_curling/digital_curling_strategist.hpp"
#include "servo/game/rules.hpp"

namespace hogline::hw::digital_curling::test {

using namespace std::chrono_literals;

inline SessionConfig session_of(Team team, int ends = 2) {
  SessionConfig config;
  config.team = team;
  config.identity = {"6f2f6f8e-0000-4000-8000-000000000001", "2026-11-22T10:05:00+00:00"};
  config.offer.setting.ends = ends;
  config.offer.setting.thinking = {600s, 600s};
  config.offer.setting.extra_thinking = {60s, 60s};
  config.offer.players = {PlayerSkill{3.9, 0.006, 0.0005}, PlayerSkill{3.9, 0.006, 0.0005}};
  config.connect_deadline = 60s;
  return config;
}

/// The update before a game's first throw, which is the first team's.
inline servo::GameUpdate first_update(const SessionConfig& config) {
  return {servo::new_game(config.offer.setting), {}};
}

}  // namespace hogline::hw::digital_curling::test
