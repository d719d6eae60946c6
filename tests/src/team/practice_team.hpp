// Both practice robots on the practice rink, for tests.
#pragma once

#include "src/config/embedded.hpp"
#include "src/skip/skip_set.hpp"
#include "src/team/simulated_team.hpp"

namespace hogline::test {

inline TeamRequest practice_team(std::uint64_t seed) {
  TeamRequest request;
  request.thrower = config::parse_thrower_rig(config::embedded_file("rigs/practice.yaml"), "practice rig");
  request.skip = load_skip_rig_or_practice("");
  request.scenario = load_skip_scenario("", seed);
  request.render_threads = 1;
  return request;
}

}  // namespace hogline::test
