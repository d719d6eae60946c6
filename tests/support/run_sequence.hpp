// A run as the low camera sees it: towards the hog line at a constant acceleration, on a body that rocks, until the
// line has left the picture. Rendered by hw/sim frame by frame, through motion blur, with exact truth.
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

/// A stretch of time at one acceleration.
struct RunLeg {
  double duration_s = 0.0;
  double acceleration_mps2 = 0.0;
};

/// All that can be chosen. As it stands: 2.6 m/s from 2.5 m before the hog line to 0.35 m before it.
struct RunMove {
  double speed_mps = 2.6;  ///< at the first frame
  double acceleration_mps2 = 0.0;
  std::vector<RunLeg> legs;  ///< where there are any, they say how it goes on after the first frame, and how long
  double first_hog_distance_m = 2.5;
  double last_hog_distance_m = 0.35;
  double x_m = 0.05;  ///< at the first frame
  double yaw_rad = -0.003;
  double yaw_rate_radps = 0.01;
  double rock_rad = 0.003;  ///< amplitude of the body's pitch
  double rock_hz = 3.0;
  double squat_rad_per_mps2 = 0.004;  ///< the nose rises by this for each m/s2
  double rate_hz = 60.0;
  double exposure_s = 0.003;
  vision::Ice ice{0.007, 1.309};
  vision::SidelineKind known_sideline = vision::SidelineKind::line;  ///< as the rig file says
  hw::sim::RinkAppearance rink;
  hw::sim::SensorModel sensor;
  std::uint64_t seed = 1;
};

/// Any speed from 1.8 to 3.5 m/s, with and without acceleration, on a sheet of any of four palettes and dividers.
RunMove random_run(std::uint64_t seed);

struct RunFrame {
  cv::Mat bgr;  ///< CV_8UC3
  Stamp stamp{};
  PlanarPose body;   ///< true: the camera's place less the mount's offset
  vision::Pose eMc;  ///< true
  double hog_distance_m = 0.0;
};

/// Frames are rendered when asked for (about 20 ms), in any order; the same move gives the same bytes.
class RunSequence {
 public:
  explicit RunSequence(const RunMove& move, int threads = 1);

  /// As a rig file would give it: the mount of a body that does not rock, the nominal width of the sheet.
  const vision::CameraSetup& setup() const { return setup_; }
  int size() const { return frames_; }
  /// Precondition: 0 <= k < size().
  RunFrame frame(int k) const;

 private:
  struct Motion {
    double way_m = 0.0;
    double speed_mps = 0.0;
    double acceleration_mps2 = 0.0;
  };
  Motion motion(double t_s) const;
  double pitch_rad(double t_s, const Motion& now) const;

  RunMove move_;
  vision::CameraSetup setup_;
  hw::sim::SheetRenderer renderer_;
  int frames_ = 0;
};

}  // namespace hogline::testing
