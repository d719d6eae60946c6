// The same throw against the wall clock: the rink, the looks and the control loop in threads of their own.
#pragma once

#include "src/throwing/simulated_throw.hpp"

namespace hogline {

/// Rink: steps to the wall clock, a millisecond at a time. Eyes: render (on steel: wait for) the newest frame and look
/// at it (VisionThread). Control: every control period, whatever the others do. The devices and the rink share one
/// lock, which nobody holds while rendering or looking. Not repeatable: what a busy machine does is in it.
/// `result.realtime` holds the latencies.
ThrowOutcome throw_in_real_time(const ThrowRequest& request, const Progress& progress);

}  // namespace hogline
