// From the kernel's receive time, which is wall clock, to the steady clock.
#pragma once

#include <optional>

#include "vision/percepts/stamp.hpp"

namespace hogline::hw {

/// The two clocks, read one right after the other.
struct ClockPair {
  Duration wall{};  ///< since the Unix epoch
  Stamp steady{};
};

/// The steady time of an event stamped `wall`, by its age now. The wall clock may be set at any time; the age is then
/// wrong if the step fell between the event and now. Ages below -1 ms or above `oldest` give nothing.
std::optional<Stamp> to_steady(Duration wall, const ClockPair& now, Duration oldest);

}  // namespace hogline::hw
