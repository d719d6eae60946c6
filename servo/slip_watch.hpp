// Whether the wheels spin: the way they measure against the way the looks see.
#pragma once

#include <deque>
#include <optional>

#include "vision/percepts/stamp.hpp"

namespace hogline::servo {

/// Compares the way between two looks a quarter of a second apart. A body that rolls differs by its looks' noise and a
/// few per mille; one whose wheels spin at 0.1 m/s more than it moves, by 25 mm. Slipping ends when half as much is
/// left. Not for looks that share no scale with the wheels: hand the speed with the odometry's learnt scale in it.
class SlipWatch {
 public:
  /// Stamps that do not grow are ignored.
  void wheels(Stamp stamp, double forward_mps);
  /// Precondition: finite, sigma_m > 0.
  void look(Stamp stamp, double hog_distance_m, double sigma_m);

  bool slipping() const { return slipping_; }
  bool ever() const { return ever_; }
  double slip_mps() const { return slip_mps_; }  ///< of the last comparison: wheels less body

 private:
  struct Way {
    Stamp stamp{};
    double way_m = 0.0;
  };
  struct Look {
    Stamp stamp{};
    double hog_distance_m = 0.0;
    double sigma_m = 0.0;
    double way_m = 0.0;  ///< of the wheels, at its stamp
  };
  std::optional<double> way_at(Stamp stamp) const;
  void compare();

  std::deque<Way> ways_;
  std::deque<Look> looks_;
  double speed_mps_ = 0.0;
  double slip_mps_ = 0.0;
  bool slipping_ = false;
  bool ever_ = false;
};

}  // namespace hogline::servo
