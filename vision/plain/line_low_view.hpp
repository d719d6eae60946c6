// The low view as plain vpMeLine would have it: one tracker for each line of the H, on undistorted grey pictures;
// distance, direction and offset from where the calibrated mount puts the lines on the ice. Not what hogline throws
// with: what it is compared with. Read by C++17 and C++20 alike.
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>

#include "vision/geometry/lens.hpp"
#include "vision/geometry/pose.hpp"

namespace hogline::vision::plain {

struct LineLook {
  bool ok = false;
  std::string reason;              ///< when not ok
  PlanarPose body;                 ///< in e
  double distance_per_px_m = 0.0;  ///< what a pixel is worth on the ice, in the middle of the hog line
};

/// Follows the hog line's house-side edge, the centre line and both sidelines, where they are in view. Knows neither
/// ice nor how the body rocks.
class LineLowView {
 public:
  LineLowView(const Intrinsics& intrinsics, const Mount& mount, double sheet_width_m);
  ~LineLowView();
  LineLowView(const LineLowView&) = delete;
  LineLowView& operator=(const LineLowView&) = delete;

  /// The matrix of the undistorted picture that start() and look() want: CV_8UC1, that of Undistortion.
  /// Starts every line where a pose near the truth puts it.
  void start(const cv::Mat& flat_grey, const Pose& eMc);
  /// A line that was lost is started where the last look puts it.
  LineLook look(const cv::Mat& flat_grey);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hogline::vision::plain
