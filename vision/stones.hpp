// The stones on the sheet, from one picture of the near view and the sheet's pose in it (Yoon et al., section III.C):
// coarse boxes around groups, votes for centres, a joint refinement, teams by colour.
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "vision/camera_setup.hpp"
#include "vision/detect/stone_groups.hpp"
#include "vision/detect/stone_team.hpp"
#include "vision/detect/stone_vote.hpp"
#include "vision/fit/stone_fit.hpp"
#include "vision/geometry/stone_shape.hpp"
#include "vision/percepts/stones.hpp"
#include "vision/stone_verdict.hpp"

namespace hogline::vision {

struct StonesSetup {
  CameraSetup camera;
  StoneShape shape;
  TeamHues teams;
};

/// What was seen on the way: for drawings and for people who ask why.
struct StonesSketch {
  std::vector<cv::Rect> boxes;
  struct Candidate {
    StoneCandidate votes;
    FittedStone fit;
    std::string doubt;                      ///< empty: a stone; else why it is none
    bool glimpsed = false;                  ///< judged with the club's granite known
    std::optional<Foreground> before = {};  ///< what somebody hides of it, where it was left out
  };
  std::vector<Candidate> candidates;
};

/// Where a stone of this sheet can lie: not far outside of hog and back line, and its centre between the sidelines (one
/// that touches a line is out, but ours), or 45 mm before them where they are bumpers: no stone comes nearer to those
/// than its radius, and places have errors. A width that is not known is the greatest that the rules allow.
StoneArea stone_area(std::optional<double> sheet_width_m, SidelineKind sideline);

/// Why what looks like a stone is none after all, by what stands up from the ice: somebody goes on, paint has no grip.
/// The handle's direction goes into its sighting. `places` are those of all that look like stones.
std::string last_doubt(const StonePicture& picture, const JudgedStone& stone,
                       const std::vector<Eigen::Vector2d>& places, StoneSighting& sighting);

class StoneFinder {
 public:
  explicit StoneFinder(const StonesSetup& setup);
  ~StoneFinder();
  StoneFinder(StoneFinder&&) noexcept;
  StoneFinder& operator=(StoneFinder&&) noexcept;

  /// `image` is CV_8UC3 (BGR) of the setup's size in the camera's response curve (else !ok). `eMc` is the camera's pose
  /// in it, `sheet_width_m` the distance of the sidelines where it is known: stones beyond them are not reported.
  StonesPercept find(const cv::Mat& image, Stamp stamp, const Pose& eMc, std::optional<double> sheet_width_m,
                     StonesSketch* sketch = nullptr);

  /// The first step's, for this mount.
  StoneGroupFinder& groups();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hogline::vision
