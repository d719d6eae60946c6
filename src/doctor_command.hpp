// `hogline doctor`: opens every device of a rig, says what it finds and what to do, moves nothing.
#pragma once

#include <string>

namespace hogline {

struct DoctorOptions {
  std::string rig;
  bool simulated = false;  ///< the simulated rink's devices in the place of the rig's
  bool json = false;
};

/// 0: all well, 1: something is wrong. Throws ConfigError for wrong use.
int run_doctor(const DoctorOptions& options);

}  // namespace hogline
