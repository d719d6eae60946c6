#include "servo/stone_motion_model.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "servo/stone_flow.hpp"

namespace hogline::servo {
namespace {

constexpr double longest_step_s = 0.5;

Slid slid(const StoneFlow& flow) {
  Slid to;
  to.stone = {flow.state[0], flow.state[1], flow.state[2], flow.state[3], flow.spin_radps};
  to.by_start = flow.by_start;
  to.at_rest = flow.state[2] == 0.0 && flow.state[3] == 0.0;
  return to;
}

/// Up to the last phase, or to the end of the time; `left_s` is what is left of it.
StoneFlow run(StoneFlow flow, const IceFactors& ice, double& left_s) {
  while (left_s > 0.0 && !in_last_phase(flow)) {
    const double step = std::min(left_s, step_s(flow, ice, longest_step_s));
    flow = stepped(flow, ice, step);
    left_s -= step;
  }
  return flow;
}

Slid slide_back(const SlidingStone& stone, const IceFactors& ice, double dt_s) {
  StoneFlow flow = flow_from(stone);
  if (speed_mps(flow) == 0.0) return slid(flow);
  for (double left_s = -dt_s; left_s > 0.0;) {
    const double step = std::min(left_s, step_s(flow, ice, longest_step_s));
    flow = stepped(flow, ice, -step);
    left_s -= step;
  }
  return slid(flow);
}

}  // namespace

Slid slide(const SlidingStone& stone, const IceFactors& ice, double dt_s) {
  assert(ice.friction_scale > 0.0 && std::isfinite(dt_s) && std::isfinite(speed_mps(stone)));
  if (dt_s < 0.0) return slide_back(stone, ice, dt_s);
  double left_s = dt_s;
  const StoneFlow flow = run(flow_from(stone), ice, left_s);
  return slid(in_last_phase(flow) ? in_last_phase_after(flow, ice, left_s) : flow);
}

Rest rest_of(const SlidingStone& stone, const IceFactors& ice) {
  assert(ice.friction_scale > 0.0 && std::isfinite(speed_mps(stone)));
  const double ever_s = 1e6;
  double left_s = ever_s;
  const StoneFlow flow = run(flow_from(stone), ice, left_s);
  const double last_s = last_phase_s(flow, ice);
  const StoneFlow at = in_last_phase_after(flow, ice, last_s);
  return {at.state[0], at.state[1], ever_s - left_s + last_s, at.by_start.topRows<2>()};
}

}  // namespace hogline::servo
