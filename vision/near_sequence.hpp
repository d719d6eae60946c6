// The near view over consecutive frames: acquires the sheet once, then tracks it at a fraction of the cost, knows when
// it is lost and acquires again by itself.
//
//   NearSequence near(setup);
//   for each frame: const SheetPosePercept& p = near.step(image, stamp, gyro_yaw_increment);
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "vision/camera_setup.hpp"
#include "vision/near_view.hpp"
#include "vision/percepts/sheet_pose.hpp"

namespace hogline::vision {

/// What was done with the last frame.
struct NearSequenceDiagnosis {
  bool tracked = false;     ///< the percept is the tracker's; else the acquisition's, where it is ok
  std::string lost;         ///< why the frame was not tracked; empty when it was
  int frames_tracked = 0;   ///< in a row, up to this one
  int places = 0;           ///< edge sites the tracker looked for
  int moved = 0;            ///< of them found by the moving edges
  double search_px = 0.0;   ///< the widest search along an edge's normal
  double innovation = 0.0;  ///< of the fit beside the prediction, in standard deviations
};

class NearSequence {
 public:
  explicit NearSequence(const CameraSetup& setup);
  ~NearSequence();
  NearSequence(NearSequence&&) noexcept;
  NearSequence& operator=(NearSequence&&) noexcept;

  /// One frame, as for NearView::acquire(). Stamps must grow: one that does not is refused (ok == false) and changes
  /// nothing. `yaw_increment_rad` is the body's turn since the frame before by the gyro, counter-clockwise positive;
  /// without it the last frames' own motion predicts. The first of the percept's features is "tracked" or "acquired".
  /// The reference holds until the next call. A tracked frame allocates no memory (after the first ones).
  const SheetPosePercept& step(const cv::Mat& image, Stamp stamp,
                               std::optional<double> yaw_increment_rad = std::nullopt,
                               NearViewSketch* sketch = nullptr);

  const NearSequenceDiagnosis& diagnosis() const;

  /// Frames further apart than this are not tracked but acquired.
  static constexpr double longest_gap_s = 0.25;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hogline::vision
