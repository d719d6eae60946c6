// The far view: stones down the sheet, seen by the long lens on the head, in the end's frame e. The body's pose comes
// from the near view, the head's angles from its drives; what the far picture shows of the sheet corrects pan, tilt and
// roll (0.25 deg of tilt is 0.8 m at 20 m), and the stones are placed through the corrected pose.
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vision/camera_setup.hpp"
#include "vision/detect/stone_team.hpp"
#include "vision/far_view/far_plan.hpp"
#include "vision/geometry/stone_shape.hpp"
#include "vision/percepts/far_look.hpp"

namespace hogline::vision {

struct FarSetup {
  CameraSetup camera;  ///< the far camera; its mount is not used: the plan says where it looks
  StoneShape shape;
  TeamHues teams;
};

/// What was seen on the way: for drawings and for people who ask why.
struct FarSketch {
  struct Candidate {
    cv::Point2d pixel;  ///< of the handle's centre
    double x_m = 0.0;
    double y_m = 0.0;
    std::string doubt;  ///< empty: a stone; else why it is none
  };
  std::vector<Candidate> candidates;
};

/// One picture at a time, without memory of the one before (but its buffers).
class FarView {
 public:
  explicit FarView(const FarSetup& setup);
  ~FarView();
  FarView(FarView&&) noexcept;
  FarView& operator=(FarView&&) noexcept;

  /// `image` is CV_8UC3 (BGR) of the setup's size in the camera's response curve (else !ok).
  FarPercept look(const cv::Mat& image, Stamp stamp, const FarPlan& plan, FarSketch* sketch = nullptr);

 private:
  friend class FarSequence;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Consecutive pictures of a head that may turn. What earlier pictures told of the correction is a prior for the next
/// one, so that a picture with few lines is no loss, and stones are looked for where they are expected; the whole
/// picture is searched for others a part at a time.
class FarSequence {
 public:
  explicit FarSequence(const FarSetup& setup);
  ~FarSequence();
  FarSequence(FarSequence&&) noexcept;
  FarSequence& operator=(FarSequence&&) noexcept;

  /// `plan.eMc` is of this picture's stamp. `expected` may be empty.
  FarPercept look(const cv::Mat& image, Stamp stamp, const FarPlan& plan,
                  const std::vector<StoneExpectation>& expected);

  /// The next picture has no predecessor.
  void forget();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hogline::vision
