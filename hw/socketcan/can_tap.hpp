// Where a bus adapter reports every frame that really was on the bus.
#pragma once

#include "hw/socketcan/candump_log.hpp"

namespace hogline::hw {

class CanTap {
 public:
  virtual ~CanTap() = default;
  /// Called from the thread that uses the bus, in the midst of a control period: must not block.
  virtual void record(const CandumpRecord& record) = 0;
};

}  // namespace hogline::hw
