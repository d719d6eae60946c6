// A robot that stands still sees the same stones again and again: their mean over the frames, without the outliers.
#pragma once

#include <vector>

#include "vision/percepts/stones.hpp"

namespace hogline::vision {

class StoneAverage {
 public:
  /// The stones of one more frame; a percept that is not ok counts for nothing.
  void add(const StonesPercept& frame);

  int frames() const { return frames_; }

  /// Stones seen in at least half of the frames: the place is the mean of what lies within three robust sigmas of the
  /// median, the covariance that of a frame divided by what the frames' scatter says, but never below what all frames
  /// have in common (the pose, the shape: `common_share` of a frame's variance). The team is the frames' majority, and
  /// unknown without one; the handle's angle the mean of those measured, where half of the frames have it.
  std::vector<StoneSighting> stones() const;

  static constexpr double common_share = 0.5;

 private:
  struct Track {
    std::vector<StoneSighting> seen;
  };
  int frames_ = 0;
  std::vector<Track> tracks_;
};

}  // namespace hogline::vision
