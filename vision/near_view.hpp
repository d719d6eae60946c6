// Near-view sheet pose: acquisition by the chain of Yoon et al. (see detect/four_points.hpp), then refinement to every
// painted edge.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "vision/camera_setup.hpp"
#include "vision/percepts/sheet_pose.hpp"

namespace hogline::vision {

/// What was seen on the way, in pixels of the raw picture: for drawings and for people who ask why.
struct NearViewSketch {
  std::vector<std::vector<Eigen::Vector2d>> hog_candidates;  ///< poly-lines, bent by the lens
  std::vector<std::vector<Eigen::Vector2d>> left_candidates;
  std::vector<std::vector<Eigen::Vector2d>> right_candidates;
  std::vector<Eigen::Vector2d> ring_contour;        ///< outer ring, as segmented
  std::vector<Eigen::Vector2d> four_points;         ///< tangency points: 0 or 4
  std::vector<std::vector<Eigen::Vector2d>> model;  ///< the painted sheet where the estimate puts it
};

class NearView {
 public:
  explicit NearView(const CameraSetup& setup);
  ~NearView();
  NearView(NearView&&) noexcept;
  NearView& operator=(NearView&&) noexcept;

  /// Looks for the sheet with no more knowledge than the mount and that the robot stands before the house, within
  /// +-1.2 m of the centre line and +-15 degrees of its direction. `image` is CV_8UC3 (BGR) of the setup's size in the
  /// camera's response curve; anything else gives ok == false. `sketch` may be null.
  SheetPosePercept acquire(const cv::Mat& image, Stamp stamp, NearViewSketch* sketch = nullptr);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hogline::vision
