// Where a set of powered axes is between unknown and moving: the same for wheels and head.
#pragma once

namespace hogline::hw {

enum class DrivePhase {
  booting,   ///< nodes not yet identified and configured
  ready,     ///< configured, not energised: does not move
  enabling,  ///< on its way to enabled
  enabled,   ///< follows commands
  stopping,  ///< quick stop running
  stopped,   ///< quick stop done, not energised
  faulted,   ///< `error` says why; only rearm() leaves this phase
};

}  // namespace hogline::hw
