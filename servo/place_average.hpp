// A robust average of what several looks say of a body that stands.
#pragma once

#include <optional>
#include <vector>

#include "vision/percepts/sheet_pose.hpp"

namespace hogline::servo {

/// The body's place in e. The sigmas are those of one look, or the looks' spread where that is larger: looks from the
/// same place share their errors, so many of them are not worth more than one.
struct StandingPlace {
  PlanarPose body;
  PlanarSigma sigma;
  double hog_distance_m = 0.0;
  double hog_distance_sigma_m = 0.0;
  int used = 0;
  int thrown_out = 0;  ///< outliers
};

/// Collects looks. Outliers are judged by their distance from the median, in the scaled median of such distances.
class PlaceAverage {
 public:
  /// Looks that are not ok, or of a stamp already taken, are ignored.
  void add(const SheetPosePercept& look);
  void clear() { looks_.clear(); }
  int size() const { return static_cast<int>(looks_.size()); }
  /// Nothing while there are none.
  std::optional<StandingPlace> average() const;

 private:
  std::vector<SheetPosePercept> looks_;
};

}  // namespace hogline::servo
