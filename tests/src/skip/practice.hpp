// A throw of the practice rink, for tests.
#pragma once

#include "servo/ice_model.hpp"
#include "src/skip/skip_set.hpp"

namespace hogline::test {

inline SkipRequest practice_throw(ThrowKind kind, std::uint64_t seed) {
  SkipRequest request;
  request.rig = load_skip_rig_or_practice("");
  request.scenario = load_skip_scenario("", seed);
  set_rates(request.scenario, 20.0, 20.0);
  request.scene = draw_scene(kind, request.scenario, seed);
  request.ice = servo::IceModel(servo::IceModelConfig{}).estimate();
  request.released_after = std::chrono::seconds(3);
  return request;
}

}  // namespace hogline::test
