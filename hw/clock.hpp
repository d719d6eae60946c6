// The only way to learn the time. Real and stepped clocks implement it.
#pragma once

#include "vision/percepts/stamp.hpp"

namespace hogline::hw {

class Clock {
 public:
  virtual ~Clock() = default;
  virtual Stamp now() const = 0;
};

/// The machine's steady clock.
class SteadyClock final : public Clock {
 public:
  Stamp now() const override { return std::chrono::steady_clock::now(); }
};

/// A clock that stands still until it is stepped: simulations and tests. Starts at the given stamp.
class SteppedClock final : public Clock {
 public:
  explicit SteppedClock(Stamp start = Stamp{}) : now_(start) {}
  Stamp now() const override { return now_; }
  /// Advances the clock. Precondition: step >= 0.
  void advance(Duration step) { now_ += step; }

 private:
  Stamp now_;
};

}  // namespace hogline::hw
