// What a pair of axes (axis_pair.hpp) needs of each.
#pragma once

#include "hw/canopen/drive_node.hpp"

namespace hogline::hw {

/// A drive node and what turns on it: it adds its own plausibility to the node's supervision.
class DrivenAxis {
 public:
  virtual ~DrivenAxis() = default;
  virtual DriveNode& node() = 0;
  virtual const DriveNode& node() const = 0;
  virtual void boot(Stamp now) = 0;
  virtual void on_frame(const StampedCanFrame& received, Stamp now) = 0;
  virtual void step(Stamp now) = 0;
};

}  // namespace hogline::hw
