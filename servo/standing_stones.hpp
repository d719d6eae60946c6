// Stones that lie on the sheet before a throw: the mean of many looks, without what only some of them show.
#pragma once

#include <vector>

#include "vision/percepts/stones.hpp"

namespace hogline::servo {

class StandingStones {
 public:
  /// A percept that is not ok counts for nothing.
  void add(const StonesPercept& look);
  int looks() const { return looks_; }

  /// Those that at least half of the looks show, nearest to the skip first. Each place is the mean, weighted by the
  /// covariances; its covariance is never less than half of one look's, which is what looks from one place share. The
  /// team is that of most looks that could tell.
  std::vector<StoneSighting> stones() const;

 private:
  struct Group {
    std::vector<StoneSighting> seen;
  };
  int looks_ = 0;
  std::vector<Group> groups_;
};

}  // namespace hogline::servo
