// The near view's stones over consecutive pictures, at a fraction of the finder's cost: stones that were seen a moment
// ago are fitted where they must be now, all of them in every picture, so that one that was hit is noticed at once; the
// rest of the picture is searched for granite that they do not explain, a part at a time.
//
//   StoneSequence stones(setup);
//   for each picture: StonesPercept p = stones.look(picture, stamp, eMc, sheet_width_m, where_a_tracker_expects_them);
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "vision/geometry/pose.hpp"
#include "vision/percepts/stones.hpp"
#include "vision/stones.hpp"

namespace hogline::vision {

/// What was done with the last picture.
struct StoneSequenceDiagnosis {
  bool whole = false;  ///< the finder looked at all of it
  int followed = 0;    ///< stones that are where they were foretold
  int lost = 0;        ///< known stones that are not, before the search round about
  int asked = 0;       ///< other places that were asked whether they are a stone
};

class StoneSequence {
 public:
  /// The setup's mount is not used: a camera on a head is where `eMc` says.
  explicit StoneSequence(const StonesSetup& setup);
  ~StoneSequence();
  StoneSequence(StoneSequence&&) noexcept;
  StoneSequence& operator=(StoneSequence&&) noexcept;

  /// As StoneFinder::find(), and as good: each stone of the percept is measured in this picture alone. `expected` may
  /// be empty; then stones are foretold by their own motion. Stamps must grow: with one that does not, or that leaves a
  /// gap of more than a second, the picture is taken as the first.
  StonesPercept look(const cv::Mat& image, Stamp stamp, const Pose& eMc, std::optional<double> sheet_width_m,
                     const std::vector<StoneExpectation>& expected);

  /// The next picture has no predecessor.
  void forget();

  const StoneSequenceDiagnosis& diagnosis() const;

  /// The finder for a camera that is held like this one. Made when it is first asked for; it costs some milliseconds.
  StoneFinder& finder(const Pose& eMc);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hogline::vision
