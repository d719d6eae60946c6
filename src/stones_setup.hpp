// What the stone finder is told by the rig file.
#pragma once

#include "src/config/rig.hpp"
#include "vision/stones.hpp"

namespace hogline {

/// Throws ConfigError where the rig has no near camera.
inline vision::StonesSetup stones_setup(const config::Rig& rig) {
  vision::StonesSetup setup;
  setup.camera = rig.camera("near");
  setup.shape.handle_radius_m = rig.stone.radius_m;
  setup.shape.handle_height_m = rig.stone.height_m;
  return setup;
}

}  // namespace hogline
