// What the skip must be told.
#pragma once

#include <optional>

#include "servo/collision_watch.hpp"
#include "servo/head_aiming.hpp"
#include "servo/ice_model.hpp"
#include "servo/shot_aiming.hpp"
#include "servo/skip_sheet.hpp"
#include "servo/throw_fit.hpp"

namespace hogline::servo {

/// How old what is relied on may be.
struct SkipAges {
  Duration head{};   ///< the joints' feedback
  Duration pose{};   ///< the sheet's pose, while a throw is followed; people may stand before the sheet
  Duration far{};    ///< the far camera's pictures, while the stone is beyond the hog line
  Duration stone{};  ///< a stone that runs and is not seen for so long is lost
};

/// Each state's deadline.
struct SkipDeadlines {
  Duration boot{};
  Duration look{};
  Duration aim{};
  Duration wait{};    ///< for a stone to be thrown
  Duration follow{};  ///< from the release, or first sight, to the rest of all
};

struct SkipConfig {
  HeadAimingConfig aiming;
  HeadGeometry near_head;  ///< the near camera on the same head
  CollisionWatchConfig watch;
  double far_tilt_sigma_rad = 0.0;  ///< what all looks of a view share, beyond what their percepts say
  double near_tilt_sigma_rad = 0.0;
  ThrowFitConfig fit;
  std::optional<PlanarPose> known_body{};  ///< then sheet and standing stones are not looked at first
  HeadAngles look;                         ///< of the head while sheet and stones are measured
  int look_frames = 0;                     ///< pictures that are taken for it
  Duration settle{};                       ///< the head stands for so long before they count
  Place wait_at;                           ///< where the head waits for the stone
  double hand_over_y_m = hog_line_m;       ///< far view beyond it, near view on this side
  double hand_over_overlap_m = 1.0;        ///< both views are taken within this of it
  double moved_m = 0.05;  ///< the body has been moved if the near view says that it stands elsewhere by this
  double moved_rad = 0.01;
  double expected_spin_radps = 0.0;  ///< as ordered; 0: not known
  SkipAges ages;
  SkipDeadlines deadlines;
};

}  // namespace hogline::servo
