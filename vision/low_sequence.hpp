// The low view over a run: acquires the hog line once, then tracks it at a fraction of the cost, through motion blur,
// until it leaves the bottom of the picture; from there the distance is carried on by dead reckoning while direction
// and lateral offset are still measured. Knows when it is lost and acquires again by itself.
//
//   LowSequence low(setup);
//   for each frame: const SheetPosePercept& p = low.step(image, stamp);
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>

#include "vision/low_view.hpp"

namespace hogline::vision {

/// What was done with the last frame.
struct LowSequenceDiagnosis {
  bool tracked = false;     ///< the tracker followed the paint
  bool blind = false;       ///< the hog line is below the picture: the distance is dead-reckoned
  std::string lost;         ///< why the frame was not tracked; empty when it was
  int frames_tracked = 0;   ///< in a row, up to this one
  int places = 0;           ///< edge sites the tracker looked for
  double search_px = 0.0;   ///< the widest search along an edge's normal
  double innovation = 0.0;  ///< of the fit beside the prediction, in standard deviations
};

class LowSequence {
 public:
  /// `exposure_s` of the camera: how much motion blur to expect.
  explicit LowSequence(const CameraSetup& setup, double exposure_s = 0.003);
  ~LowSequence();
  LowSequence(LowSequence&&) noexcept;
  LowSequence& operator=(LowSequence&&) noexcept;

  /// One frame, as for LowView::acquire(). Stamps must grow: one that does not is refused (ok == false) and changes
  /// nothing. The first of the percept's features is "tracked", "acquired" or "dead_reckoning"; a dead-reckoned
  /// distance is ok, says so in growing sigmas, and ends after `longest_blind_s`. A tracked frame that does not show
  /// both sidelines well gives the acquisition's width of the sheet. The reference holds until the next
  /// call. A tracked frame allocates no memory (after the first ones).
  const SheetPosePercept& step(const cv::Mat& image, Stamp stamp, LowViewSketch* sketch = nullptr);

  /// What the frames so far say of the next one. Nothing of the body before the first good frame.
  LowViewPrediction predict(Stamp stamp) const;

  const LowSequenceDiagnosis& diagnosis() const;

  static constexpr double longest_blind_s = 0.5;
  /// Frames further apart than this are not tracked but acquired.
  static constexpr double longest_gap_s = 0.1;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hogline::vision
