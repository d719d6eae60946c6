// The visual-servoing task of the head: bring one image point to where it is wanted by pan and tilt.
#pragma once

#include <memory>
#include <string>

#include "servo/head_kinematics.hpp"

namespace hogline::servo {

struct GazeGains {
  double at_zero_per_s = 0.0;      ///< of the adaptive gain, at no error,
  double at_infinity_per_s = 0.0;  ///< far off,
  double slope_per_s = 0.0;        ///< and how steeply it goes from one to the other
};

/// The control law's answer. `ok == false`: no law, with the reason; then the rates must not be used.
struct GazeLaw {
  bool ok = false;
  std::string reason;
  double pan_radps = 0.0;
  double tilt_radps = 0.0;
};

/// vpServo, eye in hand, one vpFeaturePoint, the head's own Jacobian, adaptive gain; what the point moves by itself is
/// fed forward: q' = -J^+ (gain e + de/dt).
class GazeTask {
 public:
  /// `wanted_x`, `wanted_y`: where the point shall be, at depth 1; 0, 0 is the optical axis.
  GazeTask(const HeadGeometry& head, const GazeGains& gains, double wanted_x = 0.0, double wanted_y = 0.0);
  ~GazeTask();
  GazeTask(GazeTask&&) noexcept;
  GazeTask& operator=(GazeTask&&) noexcept;

  /// `point`: where it is in the picture; `x_per_s`, `y_per_s`: how it would move there if the head stood still.
  GazeLaw law(const HeadAngles& q, const SeenPoint& point, double x_per_s, double y_per_s);

 private:
  struct Task;
  std::unique_ptr<Task> task_;
};

}  // namespace hogline::servo
