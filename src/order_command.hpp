// `hogline order`: one shot ordered by hand, in the place of the rig's robot.
#pragma once

#include <string>

namespace hogline {

struct OrderOptions {
  std::string rig;
  double speed_mps = 2.09;
  double heading_deg = 0.0;
  double spin_radps = 1.5;  ///< counter-clockwise from above positive
  double wait_s = 60.0;     ///< for the thrower to be armed
  bool stay = false;        ///< go on sending heartbeats after the throw
};

int run_order(const OrderOptions& options);

}  // namespace hogline
