#include "hw/sim/board_run.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::hw::sim {
namespace {

constexpr double step_s = 1e-3;
constexpr double longest_s = 120.0;  // no stone runs for two minutes

bool runs(const std::optional<StoneTruth>& stone) { return stone && moves(*stone); }

bool out(const StoneTruth& stone, double radius_m, const PlayBounds& bounds) {
  const bool aside = bounds.sheet_width_m && std::abs(stone.x_m) + radius_m >= 0.5 * *bounds.sheet_width_m;
  return aside || stone.y_m - radius_m >= bounds.back_line_y_m;
}

void slide_all(BoardStones& stones, const StoneScenario& scenario, const PlayBounds& bounds) {
  for (auto& stone : stones) {
    if (!runs(stone)) continue;
    slide(*stone, scenario, step_s);
    stone->handle_rad += stone->spin_radps * step_s;
    if (out(*stone, scenario.radius_m, bounds)) stone.reset();
  }
}

/// Whether the thrown one was among those that met.
bool collide_all(BoardStones& stones, std::size_t thrown, const StoneScenario& scenario) {
  bool struck = false;
  for (std::size_t i = 0; i < stones.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (!stones[i] || !stones[k] || !(runs(stones[i]) || runs(stones[k]))) continue;
      const bool met = collide(*stones[k], *stones[i], scenario);
      struck = struck || (met && (i == thrown || k == thrown));
    }
  }
  return struck;
}

}  // namespace

BoardRun run_to_rest(BoardStones stones, std::size_t thrown, const StoneScenario& scenario, const PlayBounds& bounds,
                     double frame_s) {
  BoardRun run;
  const int steps_a_frame = frame_s > 0.0 ? std::max(1, static_cast<int>(std::lround(frame_s / step_s))) : 0;
  int steps = 0;
  while (std::ranges::any_of(stones, runs) && steps * step_s < longest_s) {
    slide_all(stones, scenario, bounds);
    run.struck = collide_all(stones, thrown, scenario) || run.struck;
    ++steps;
    if (steps_a_frame > 0 && steps % steps_a_frame == 0) run.frames.push_back(stones);
  }
  if (steps_a_frame > 0 && steps % steps_a_frame != 0) run.frames.push_back(stones);
  run.duration_s = steps * step_s;
  run.stones = std::move(stones);
  return run;
}

}  // namespace hogline::hw::sim
