// How a running body moves, from its last few places: along the sheet at constant acceleration, across it and in yaw at
// constant rate.
#pragma once

#include <array>
#include <cstddef>

#include "vision/percepts/sheet_pose.hpp"
#include "vision/percepts/stamp.hpp"

namespace hogline::vision {

/// A place of the run and how far it may be from the truth.
struct RunPlace {
  PlanarPose body;
  PlanarSigma sigma;
};

/// Weighted least squares over the last places; allocates nothing. A run's speeds and accelerations are known
/// beforehand to be bounded, so that few places do not invent them.
class RunMotion {
 public:
  static constexpr std::size_t most_places = 12;
  static constexpr double longest_s = 0.3;  ///< older places say little of the motion now

  void clear() { count_ = 0; }
  /// Precondition: newer than the one before, sigmas positive.
  void add(Stamp stamp, const RunPlace& place);

  bool empty() const { return count_ == 0; }
  /// The motion can be told from the places alone. Before that (and far off, where places are unsure) a body at rest up
  /// to a run at full speed is expected.
  bool known() const { return count_ >= 3; }
  /// Precondition: not empty.
  Stamp last_stamp() const { return places_[count_ - 1].stamp; }
  const PlanarPose& last() const { return places_[count_ - 1].place.body; }

  /// Where the body is at `stamp`, not older than the newest place. Precondition: not empty.
  RunPlace at(Stamp stamp) const;
  /// Along e's y, at `stamp`.
  double speed_mps(Stamp stamp) const;

 private:
  struct Place {
    Stamp stamp;
    RunPlace place;
  };
  std::array<Place, most_places> places_{};  ///< oldest first
  std::size_t count_ = 0;
};

}  // namespace hogline::vision
