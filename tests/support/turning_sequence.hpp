// The alignment move as the near camera sees it: the robot turns on the spot before the house, with people in the way
// where asked for. Rendered by hw/sim frame by frame, with exact truth and what a gyro says meanwhile.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "hw/sim/appearance.hpp"
#include "hw/sim/sheet_renderer.hpp"
#include "vision/camera_setup.hpp"
#include "vision/percepts/sheet_pose.hpp"
#include "vision/percepts/stamp.hpp"

namespace hogline::testing {

/// Somebody who walks straight on where they look to; `look` is how they are at the first frame.
struct Walker {
  hw::sim::PersonLook look;
  double speed_mps = 1.3;
};

/// All that can be chosen. As it stands: 10 degrees at up to 20 deg/s, 66 frames.
struct TurningMove {
  double start_x_m = 0.12;  ///< of b's origin in e
  double start_y_m = -3.4;
  double start_yaw_rad = -0.14;
  double turn_rad = 0.17453292519943295;               ///< counter-clockwise positive
  double max_yaw_rate_radps = 0.3490658503988659;      ///< 20 deg/s
  double yaw_acceleration_radps2 = 1.047197551196598;  ///< 60 deg/s2, of the order; the drives follow with a lag
  double drive_lag_s = 0.02;
  double slip_m_per_rad = 0.02;  ///< b's origin wanders by this while it turns, to the right
  double rock_rad = 0.0005;      ///< amplitude of pitch and roll while it turns
  double rest_s = 0.1;           ///< standing, before and after
  double rate_hz = 60.0;
  double exposure_s = 0.004;        ///< 0: no motion blur
  double pitch_error_rad = 0.0026;  ///< the true mount's pitch less the calibrated one
  double gyro_scale_error = 0.0005;
  double gyro_bias_radps = 1.5e-5;            ///< 3 deg/h
  double gyro_noise_rad_per_sqrt_s = 2.9e-5;  ///< 0.1 deg per root hour
  double gyro_late_s = 0.001;                 ///< what the gyro measures is stamped too late by this
  vision::Ice ice{0.007, 1.309};
  hw::sim::RinkAppearance rink;
  hw::sim::SensorModel sensor;
  std::vector<hw::sim::StoneLook> stones;
  std::vector<Walker> people;
  std::uint64_t seed = 1;
};

/// The plain move: painted sidelines, neighbouring sheets, two stones in the house.
TurningMove turning_move(std::uint64_t seed = 1);

/// The same with two people: one crosses the house from right to left and hides rings, tee line and centre line in
/// turn, one walks up the sheet and hides hog line and sideline.
TurningMove turning_move_among_people(std::uint64_t seed = 1);

struct TurningFrame {
  cv::Mat bgr;  ///< CV_8UC3
  Stamp stamp{};
  PlanarPose body;            ///< true
  vision::Pose eMc;           ///< true
  double yaw_rate_radps = 0;  ///< true
  /// The gyro's, since the frame before; 0 for the first frame.
  double gyro_yaw_increment_rad = 0.0;
};

/// Frames are rendered when asked for (about 17 ms; with people 32), in any order; the same move gives the same bytes.
/// The paint is blurred by the motion within the exposure; stones and people are drawn sharp.
class TurningSequence {
 public:
  explicit TurningSequence(const TurningMove& move, int threads = 1);

  /// As a rig file would give it: the calibrated mount, the nominal width of the sheet.
  const vision::CameraSetup& setup() const { return setup_; }
  int size() const { return frames_; }
  /// Precondition: 0 <= k < size().
  TurningFrame frame(int k) const;
  /// The same without the picture.
  TurningFrame truth(int k) const;

 private:
  struct Motion {
    double yaw_rad = 0.0;  ///< since the start
    double rate_radps = 0.0;
  };
  void plan();
  Motion motion_at(double t_s) const;
  double time_of(int k) const { return k / move_.rate_hz; }
  vision::Pose body_at(double t_s) const;
  double gyro_increment(int k) const;

  TurningMove move_;
  vision::CameraSetup setup_;
  vision::Pose true_bMc_;
  hw::sim::SheetRenderer renderer_;
  std::vector<Motion> motion_;  ///< a sample each millisecond
  int frames_ = 0;
};

}  // namespace hogline::testing
