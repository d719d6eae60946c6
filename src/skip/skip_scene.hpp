// What is thrown on the skip's simulated rink: stones that stand, and the one that comes.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hw/sim/skip_rink.hpp"

namespace hogline {

enum class ThrowKind { draw, guard, hit, double_hit, through, hogged, sideline };

/// The names of all kinds, in their order: "draw", "guard", "hit", "double", ...
const std::vector<std::string>& throw_kind_names();
std::optional<ThrowKind> throw_kind(std::string_view name);

struct SkipScene {
  std::vector<hw::sim::FieldStone> standing;
  hw::sim::FieldStone thrown;  ///< where and as the thrower lets it go
};

/// Draws a throw of that kind: places, weight, turn. The shot is solved for the scenario's ice, so that it becomes what
/// it is called; the thrower's scatter is in it. In e of the skip.
SkipScene draw_scene(ThrowKind kind, const hw::sim::Scenario& scenario, std::uint64_t seed);

}  // namespace hogline
