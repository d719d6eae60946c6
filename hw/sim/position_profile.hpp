// Profile position of CiA 402 (mode 1): set-points and their handshake bits, and the profile that goes there.
#pragma once

#include <cstdint>
#include <optional>

namespace hogline::hw::sim {

/// What the drive's objects say, in its own units; velocities and ramps in counts.
struct PositionProfileLimits {
  double velocity = 0.0;       ///< 6081
  double acceleration = 0.0;   ///< 6083
  double deceleration = 0.0;   ///< 6084
  double window = 0.0;         ///< 6067
  double window_time_s = 0.0;  ///< 6068
};

/// A set-point is taken at the rising edge of the controlword's bit 4. Without bit 5 a set-point that comes during a
/// motion waits, with bit 12 up, until that motion has ended.
class PositionProfile {
 public:
  /// Operation was just enabled, or the mode entered: no target, the axis is held where it is.
  void hold(double position);
  /// The rising edge. False if the drive can not take it now: one already waits.
  bool offer(double target, bool immediately);
  /// Bit 4 is down.
  void withdraw() { offered_ = false; }
  /// The velocity to demand now. `halt` is the controlword's bit 8.
  double step(double dt_s, double position, bool halt, const PositionProfileLimits& limits);

  bool acknowledged() const { return offered_ || waiting_.has_value(); }  ///< statusword bit 12
  bool reached() const { return reached_; }                               ///< bit 10

 private:
  double target_ = 0.0;
  double velocity_ = 0.0;
  std::optional<double> waiting_;
  bool offered_ = false;
  bool reached_ = true;
  double inside_s_ = 0.0;
};

}  // namespace hogline::hw::sim
