// Shows the same frames to every method and keeps what each made of them.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/contestants.hpp"

namespace hogline::bench {

/// One method on one counted frame.
struct Outcome {
  std::string footage;
  double time_s = 0.0;
  double undistort_s = 0.0;  ///< of it
  bool seen = false;         ///< an estimate, and not a wild one
  std::string reason;        ///< why not
  PlanarPose error;          ///< estimate less truth, where seen
};

struct Column {
  Contestant contestant;
  std::vector<Outcome> outcomes;
};

struct Summary {
  int frames = 0;
  int lost = 0;  ///< refused, thrown, or wild
  double median_s = 0.0;
  double p95_s = 0.0;
  double median_without_undistortion_s = 0.0;
  double yaw_rms_rad = 0.0;  ///< this and the rest over the frames seen
  double yaw_worst_rad = 0.0;
  double x_rms_m = 0.0;
  double y_rms_m = 0.0;
};

/// An estimate this far off is as bad as none: it counts as lost and not into the errors.
inline constexpr double wild_m = 0.5;
inline constexpr double wild_rad = 0.035;

/// All methods see a frame one after the other, before the next frame is made: none finds it in the processor's cache
/// from its own last look. Trackers are started a tenth of a degree and a centimetre off the truth, and again after
/// each loss.
std::vector<Column> compare(const std::vector<Contestant>& contestants, const std::vector<Footage>& footage);

/// The methods give the same answer every time, and what other programs do to the machine only adds: of two comparisons
/// of the same frames, keeps for each frame the shorter time.
void keep_shorter_times(std::vector<Column>& kept, const std::vector<Column>& again);

Summary summary_of(const Column& column);

}  // namespace hogline::bench
