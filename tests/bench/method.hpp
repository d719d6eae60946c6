// What every method under comparison looks like: a frame in, the body's pose out. Read by C++17 (the files that include
// ViSP) and C++20 alike.
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <utility>
#include <vector>

#include "vision/geometry/lens.hpp"
#include "vision/geometry/pose.hpp"
#include "vision/percepts/stamp.hpp"
#include "vision/plain/painted_line.hpp"

namespace hogline::bench {

/// The camera as a rig file gives it, the same for every method.
struct Camera {
  vision::Intrinsics intrinsics;
  vision::Mount mount;  ///< as calibrated: the true pitch differs by tenths of a degree
};

struct Frame {
  cv::Mat image;  ///< CV_8UC3, BGR
  Stamp stamp{};
  double gyro_yaw_increment_rad = 0.0;  ///< since the frame before
};

/// What a method says of one frame. Nothing but `reason` and `undistort_s` counts where `ok` is false.
struct Look {
  bool ok = false;
  std::string reason;
  PlanarPose body;
  double undistort_s = 0.0;  ///< processor time of the look that went into undistorting the picture
};

inline Look refused(std::string reason, double undistort_s = 0.0) {
  Look look;
  look.reason = std::move(reason);
  look.undistort_s = undistort_s;
  return look;
}

using vision::plain::PaintedLine;

class Method {
 public:
  Method() = default;
  Method(const Method&) = delete;
  Method& operator=(const Method&) = delete;
  virtual ~Method() = default;

  /// For methods that must be told where they start; `eMc` is near the truth. The others ignore it.
  virtual void start(const Frame& frame, const vision::Pose& eMc) = 0;

  virtual Look look(const Frame& frame) = 0;
};

}  // namespace hogline::bench
