// A pan-tilt head for the tests: joints with dead time, lag and limited acceleration, and a far camera that is not
// quite where the controller thinks.
#pragma once

#include <deque>

#include "servo/head_aiming.hpp"

namespace hogline::servo::test {

inline constexpr Duration head_period = std::chrono::milliseconds(5);

/// A head 2 m up whose far camera looks along h's x axis, turned by `yaw_rad` and `pitch_rad`.
HeadGeometry head_geometry(double pitch_rad = 0.0, double yaw_rad = 0.0);
HeadAimingConfig aiming_config();

class HeadPlant {
 public:
  HeadPlant(const HeadAngles& start, Stamp now);
  void step(double pan_radps, double tilt_radps);
  Stamp now() const { return now_; }
  const HeadAngles& angles() const { return angles_; }
  HeadAngles angles_at(Stamp stamp) const;
  /// By encoders of 0.002 deg, five milliseconds ago.
  HeadJoints measured() const;
  /// The least distance of a joint to its limits so far.
  double room_rad() const { return room_rad_; }

 private:
  struct Moment {
    Stamp stamp{};
    HeadAngles angles;
    double pan_radps = 0.0;
    double tilt_radps = 0.0;
  };
  struct Command {
    double pan_radps = 0.0;
    double tilt_radps = 0.0;
  };
  Stamp now_;
  HeadAngles angles_;
  double pan_radps_ = 0.0;
  double tilt_radps_ = 0.0;
  double room_rad_ = 10.0;
  std::deque<Moment> history_;
  std::deque<Command> on_their_way_;
};

}  // namespace hogline::servo::test
