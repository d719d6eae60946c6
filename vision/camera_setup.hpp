// Everything vision must know of a camera before it sees anything: from the rig file.
#pragma once

#include "vision/geometry/ice.hpp"
#include "vision/geometry/lens.hpp"
#include "vision/geometry/pose.hpp"
#include "vision/geometry/sheet.hpp"

namespace hogline::vision {

struct CameraSetup {
  Intrinsics intrinsics;
  Mount mount;         ///< as calibrated; the true pitch differs by up to a few tenths of a degree
  double gamma = 1.0;  ///< pixel = linear^(1/gamma)
  SheetConfig sheet;   ///< nominal: the true width is to be found
  Ice ice;
  double paint_depth_sigma_m = 0.0;  ///< prior on `ice`'s paint depth; 0: taken as given. Used by the near view.
};

}  // namespace hogline::vision
