// The whole way of a stone from a known start to rest, solved once and then read at any moment.
#pragma once

#include <optional>
#include <vector>

#include "servo/stone_flow.hpp"
#include "servo/stone_motion_model.hpp"

namespace hogline::servo {

class StonePath {
 public:
  /// Preconditions: all finite, friction_scale > 0.
  StonePath(const SlidingStone& start, const IceFactors& ice);

  /// `after_s` from the start; before it the stone is followed back. Interpolated to better than 0.1 mm.
  Slid at(double after_s) const;
  Rest rest() const;
  /// When the centre first crosses a line y = `y_m` (either way), from the start on; nothing when it never does.
  std::optional<double> crossing_s(double y_m) const;
  const SlidingStone& start() const { return start_; }
  const IceFactors& ice() const { return ice_; }

 private:
  struct Node {
    double after_s = 0.0;
    StoneFlow flow;
    StoneFlow rates;
  };
  Slid between(const Node& a, const Node& b, double after_s) const;

  SlidingStone start_;
  IceFactors ice_;
  std::vector<Node> nodes_;  ///< the last one begins the last phase
};

}  // namespace hogline::servo
