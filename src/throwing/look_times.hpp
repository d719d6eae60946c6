// How long a look takes on the robot's computer.
#pragma once

#include "vision/percepts/stamp.hpp"

namespace hogline {

/// On the simulated rink that time passes in the stepped clock: while the eyes are busy frames are missed, and what was
/// seen is known only afterwards.
struct LookTimes {
  Duration near{};     ///< the sheet is acquired
  Duration low{};      ///< the hog line is acquired
  Duration tracked{};  ///< either is tracked from the frame before
  /// False: what was seen is taken for the moment at which it is known, as if nothing took time. Only to show what that
  /// costs.
  bool compensated = true;
};

}  // namespace hogline
