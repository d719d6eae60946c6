// How fast a stone turns, from the direction of its handle.
#pragma once

#include <string>
#include <vector>

#include "servo/stone_path.hpp"
#include "vision/percepts/stamp.hpp"

namespace hogline::servo {

struct HandleLook {
  double after_s = 0.0;  ///< from the path's start
  double handle_rad = 0.0;
  double sigma_rad = 0.1;
};

/// `ok == false`: not measured, with the reason.
struct StoneRotation {
  bool ok = false;
  std::string reason;
  double spin_radps = 0.0;  ///< at the path's start, counter-clockwise from above positive
  double sigma_radps = 0.0;
  double loss = 0.0;  ///< of spin, in FCV1's: 1 as published
  int looks = 0;      ///< that agree
};

/// A grip looks the same from both ends: directions count modulo half a turn. The spin falls as the stone slows (FCV1:
/// 0.025 / v rad/s2, times a loss that is fitted too). Looks by their time; some may be wild, and the handle may be
/// hidden for a while as long as one rate alone joins what was seen before and after it. A rate is not told from one
/// that differs by half a turn from look to look: faster ones than that are not tried.
StoneRotation rotation_of(const std::vector<HandleLook>& looks, const StonePath& path);

}  // namespace hogline::servo
