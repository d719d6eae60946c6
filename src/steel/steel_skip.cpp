#include "src/steel/steel_skip.hpp"

#include <array>

#include "src/steel/rig_camera.hpp"

namespace hogline {
namespace {

std::array<std::uint8_t, 2> nodes_of(const config::SkipRig& rig) {
  return {rig.head.pan.identity.node, rig.head.tilt.identity.node};
}

}  // namespace

SteelSkip::SteelSkip(const config::SkipRig& rig, const hw::Clock& clock)
    : bus_(rig.rig, nodes_of(rig), rig.head.master_node, rig.head.duties, clock.now()),
      axes_(bus_.bus(), rig.head),
      head_(bus_, axes_),
      near_camera_(open_real_camera(rig.rig, "near", clock)),
      far_camera_(open_real_camera(rig.rig, "far", clock)),
      near_checked_(*near_camera_, watch_of(rig.rig, "near")),
      far_checked_(*far_camera_, watch_of(rig.rig, "far")) {}

}  // namespace hogline
