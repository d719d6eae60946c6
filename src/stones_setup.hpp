// What the stone finder is told by the rig file.
#pragma once

#include "src/config/rig.hpp"
#include "src/percept_json.hpp"
#include "vision/stones.hpp"

namespace hogline {

/// Throws ConfigError where the rig has no near camera.
inline vision::StonesSetup stones_setup(const config::Rig& rig) {
  vision::StonesSetup setup;
  setup.camera = rig.camera("near");
  setup.shape.handle_radius_m = rig.stone.radius_m;
  setup.shape.handle_height_m = rig.stone.height_m;
  setup.shape.rim_rounding_m = rig.stone.rim_rounding_m;
  setup.teams = {.first_rad = rig.stone.teams[0].hue_rad, .second_rad = rig.stone.teams[1].hue_rad};
  return setup;
}

/// As the rig calls the teams.
inline TeamNames team_names(const config::Rig& rig) { return {rig.stone.teams[0].name, rig.stone.teams[1].name}; }

}  // namespace hogline
