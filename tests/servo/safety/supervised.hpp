// A robot on a line, as simple as can be, for the supervisor's tests: it goes where it is driven, its wheels measure
// with a constant error, its looks are off by what the test says.
#pragma once

#include <cmath>

#include "servo/safety/supervisor.hpp"
#include "servo/unicycle.hpp"
#include "tests/servo/rig.hpp"

namespace hogline::servo::test {

inline const Stamp test_start{std::chrono::seconds(100)};

/// Pose of a camera in e, row by row, on a body with this heading and pitch.
inline std::array<double, 16> camera_pose(double yaw_rad, double pitch_rad, const std::array<double, 9>& cRb) {
  // Columns of eRb: b's forward, left and up axes in e.
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad), cp = std::cos(pitch_rad), sp = std::sin(pitch_rad);
  const std::array<double, 9> eRb{-s * cp, -c, -s * sp, c * cp, -s, c * sp, -sp, 0.0, cp};
  std::array<double, 16> eMc{};
  eMc[15] = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) eMc[4 * i + j] += eRb[3 * i + k] * cRb[3 * j + k];
    }
  }
  return eMc;
}

struct LineRobot {
  ThrowerConfig config = thrower_config();
  Stamp now = test_start;
  double hog_distance_m = 9.0;
  double speed_mps = 0.0;
  double wheel_error = 0.0;  ///< measured over true, less one
  bool held = true;
  std::optional<SheetPosePercept> low = std::nullopt;

  void move(double acceleration_mps2 = 0.0) {
    const double dt_s = seconds(period);
    hog_distance_m -= speed_mps * dt_s + 0.5 * acceleration_mps2 * dt_s * dt_s;
    speed_mps += acceleration_mps2 * dt_s;
    now += period;
  }
  void look(double error_m, double sigma_m = 0.003) {
    SheetPosePercept p;
    p.ok = true;
    p.stamp = now;
    p.hog_distance_m = hog_distance_m + error_m;
    p.hog_distance_sigma_m = sigma_m;
    p.sigma = {0.003, sigma_m, 0.001};
    p.body = {0.0, 6.401 - p.hog_distance_m, 0.0};
    p.eMc = camera_pose(0.0, 0.0, config.safety.low_cRb);
    low = p;
  }
  ThrowerObservation observe() const {
    ThrowerObservation o;
    o.now = now;
    const WheelPair wheels = wheels_of({speed_mps * (1.0 + wheel_error), 0.0}, config.base);
    o.wheels = WheelObservation{now, wheels.left_radps, wheels.right_radps, true, true};
    o.gyro = GyroObservation{now, 0.0, true};
    o.gripper = GripperObservation{now, held, !held, 1.5, {}, {}};
    o.arm = ArmObservation{now, true, false};
    o.low_view = low;
    o.operator_switch = OperatorObservation{now, true};
    return o;
  }
  ThrowerCommand drive() const {
    ThrowerCommand command;
    const WheelPair wheels = wheels_of({speed_mps, 0.0}, config.base);
    command.drive = {DriveOrder::velocity, wheels.left_radps, wheels.right_radps};
    command.camera = CameraOrder::low;
    return command;
  }
  ThrowerCommand let_go() const {
    ThrowerCommand command = drive();
    command.gripper = {true, 1.5};
    return command;
  }
  double stone_m() const { return hog_distance_m - config.release.stone_x_m; }
};

/// Armed at rest, then set in motion as if it had always run.
inline Supervisor armed(LineRobot& robot) {
  Supervisor supervisor(robot.config);
  const double speed_mps = robot.speed_mps;
  robot.speed_mps = 0.0;
  robot.look(0.0);
  supervisor.arm(robot.observe());
  supervisor.permit(robot.observe(), robot.drive(), period);
  robot.speed_mps = speed_mps;
  return supervisor;
}

inline bool moves(const ThrowerCommand& command) {
  return command.drive.order == DriveOrder::velocity || command.drive.order == DriveOrder::enable ||
         command.arm != ArmOrder::hold || command.gripper.spin_radps != 0.0;
}

}  // namespace hogline::servo::test
