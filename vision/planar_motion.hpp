// How a body moves on the ice, from its last few places.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "vision/percepts/sheet_pose.hpp"
#include "vision/percepts/stamp.hpp"

namespace hogline::vision {

/// Constant velocity by least squares over the last frames; keeps no more than it needs and allocates nothing.
class PlanarMotion {
 public:
  static constexpr std::size_t most_places = 4;

  void clear() { count_ = 0; }
  /// Precondition: newer than the one before.
  void add(Stamp stamp, const PlanarPose& body);

  bool empty() const { return count_ == 0; }
  /// The velocity can be told.
  bool known() const { return count_ >= 3; }
  /// The newest place. Precondition: not empty.
  Stamp last_stamp() const { return places_[count_ - 1].stamp; }
  const PlanarPose& last() const { return places_[count_ - 1].body; }

  /// Where the body is at `stamp`: the newest place carried on at the velocity (none until it is known).
  PlanarPose at(Stamp stamp) const;

 private:
  struct Place {
    Stamp stamp;
    PlanarPose body;
  };
  std::array<Place, most_places> places_{};  ///< oldest first
  std::size_t count_ = 0;
};

}  // namespace hogline::vision
