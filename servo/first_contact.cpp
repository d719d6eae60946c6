#include "servo/first_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hogline::servo {
namespace {

constexpr double touch_m = 2.0 * 0.145;
constexpr double shortest_step_s = 1e-3;  // 3.5 mm at the fastest: a chord of 0.005 mm's depth
constexpr double longest_step_s = 0.25;

struct Nearest {
  std::size_t stone = 0;
  double gap_m = std::numeric_limits<double>::infinity();
};

Nearest nearest(const SlidingStone& at, std::span<const Place> standing) {
  Nearest found;
  for (std::size_t i = 0; i < standing.size(); ++i) {
    const double gap = std::hypot(at.x_m - standing[i].x_m, at.y_m - standing[i].y_m) - touch_m;
    if (gap < found.gap_m) found = {i, gap};
  }
  return found;
}

Contact refined(const StonePath& path, const Place& stone, std::size_t index, double before_s, double after_s) {
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (before_s + after_s);
    const bool touches = nearest(path.at(middle).stone, {&stone, 1}).gap_m <= 0.0;
    (touches ? after_s : before_s) = middle;
  }
  return {index, after_s, path.at(after_s).stone};
}

}  // namespace

// A stone only gets slower: within the time that the gap would take at its present speed it can touch nothing.
std::optional<Contact> first_contact(const StonePath& path, std::span<const Place> standing) {
  if (standing.empty()) return std::nullopt;
  const double rest_s = path.rest().after_s;
  double before_s = 0.0;
  for (double after_s = 0.0;;) {
    const Slid slid = path.at(after_s);
    const Nearest found = nearest(slid.stone, standing);
    if (found.gap_m <= 0.0) return refined(path, standing[found.stone], found.stone, before_s, after_s);
    if (after_s >= rest_s) return std::nullopt;
    before_s = after_s;
    const double free_s = found.gap_m / std::max(speed_mps(slid.stone), 1e-6);
    after_s = std::min(after_s + std::clamp(free_s, shortest_step_s, longest_step_s), rest_s);
  }
}

}  // namespace hogline::servo
