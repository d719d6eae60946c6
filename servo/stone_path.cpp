#include "servo/stone_path.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace hogline::servo {
namespace {

constexpr double longest_step_s = 0.25;

/// Cubic through two values with their slopes.
template <class V>
V hermite(const V& a, const V& slope_a, const V& b, const V& slope_b, double h, double u) {
  const double u2 = u * u, u3 = u2 * u;
  return V((2.0 * u3 - 3.0 * u2 + 1.0) * a + (u3 - 2.0 * u2 + u) * h * slope_a + (3.0 * u2 - 2.0 * u3) * b +
           (u3 - u2) * h * slope_b);
}

}  // namespace

StonePath::StonePath(const SlidingStone& start, const IceFactors& ice) : start_(start), ice_(ice) {
  assert(ice.friction_scale > 0.0 && std::isfinite(speed_mps(start)));
  nodes_.reserve(160);
  Node node{0.0, flow_from(start), {}};
  while (!in_last_phase(node.flow)) {
    node.rates = rates_of(node.flow, ice);
    nodes_.push_back(node);
    const double step = step_s(node.flow, ice, longest_step_s);
    node.flow = stepped(node.flow, ice, step);
    node.after_s += step;
  }
  nodes_.push_back(node);
}

Slid StonePath::between(const Node& a, const Node& b, double after_s) const {
  const double h = b.after_s - a.after_s;
  // The last node has no rates: nothing is a tangent there but the flow itself.
  if (in_last_phase(b.flow)) {
    const StoneFlow to = stepped(a.flow, ice_, after_s - a.after_s);
    return {{to.state[0], to.state[1], to.state[2], to.state[3], to.spin_radps}, to.by_start, false};
  }
  const double u = (after_s - a.after_s) / h;
  const Eigen::Vector4d q = hermite(a.flow.state, a.rates.state, b.flow.state, b.rates.state, h, u);
  Slid to;
  to.stone = {q[0], q[1], q[2], q[3], (1.0 - u) * a.flow.spin_radps + u * b.flow.spin_radps};
  to.by_start = hermite(a.flow.by_start, a.rates.by_start, b.flow.by_start, b.rates.by_start, h, u);
  return to;
}

Slid StonePath::at(double after_s) const {
  if (after_s < 0.0) return slide(start_, ice_, after_s);
  const Node& last = nodes_.back();
  if (after_s >= last.after_s) {
    const StoneFlow to = in_last_phase_after(last.flow, ice_, after_s - last.after_s);
    const bool rests = to.state[2] == 0.0 && to.state[3] == 0.0;
    return {{to.state[0], to.state[1], to.state[2], to.state[3], to.spin_radps}, to.by_start, rests};
  }
  const auto next = std::upper_bound(nodes_.begin(), nodes_.end(), after_s,
                                     [](double t, const Node& node) { return t < node.after_s; });
  return between(*(next - 1), *next, after_s);
}

Rest StonePath::rest() const {
  const Node& last = nodes_.back();
  const double last_s = last_phase_s(last.flow, ice_);
  const StoneFlow at = in_last_phase_after(last.flow, ice_, last_s);
  return {at.state[0], at.state[1], last.after_s + last_s, at.by_start.topRows<2>()};
}

std::optional<double> StonePath::crossing_s(double y_m) const {
  const auto beyond = [&](double y) { return (y - y_m) * (start_.y_m - y_m) <= 0.0; };
  if (start_.y_m == y_m) return 0.0;
  const Rest end = rest();
  auto node = std::find_if(nodes_.begin(), nodes_.end(), [&](const Node& n) { return beyond(n.flow.state[1]); });
  if (node == nodes_.end() && !beyond(end.y_m)) return std::nullopt;
  double before = (node - 1)->after_s;
  double after = node == nodes_.end() ? end.after_s : node->after_s;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (before + after);
    (beyond(at(middle).stone.y_m) ? after : before) = middle;
  }
  return after;
}

}  // namespace hogline::servo
