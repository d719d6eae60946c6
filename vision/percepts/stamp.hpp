// Time as every part of hogline hands it around: an argument, never a clock that pure code reads.
#pragma once

#include <chrono>

namespace hogline {

/// A span of time. Integer nanoseconds: sums are exact and the same on every machine.
using Duration = std::chrono::nanoseconds;

/// A moment in the steady clock of the machine, or of the simulation's stepped clock. The type only names the clock;
/// vision and servo never read it. A camera frame's stamp is the middle of its exposure.
using Stamp = std::chrono::time_point<std::chrono::steady_clock, Duration>;

/// The span in seconds.
constexpr double seconds(Duration span) { return std::chrono::duration<double>(span).count(); }

/// A span from seconds, rounded to the nanosecond. Precondition: finite and within +-292 years.
constexpr Duration from_seconds(double span_s) {
  return Duration{static_cast<Duration::rep>(span_s * 1e9 + (span_s >= 0.0 ? 0.5 : -0.5))};
}

}  // namespace hogline
