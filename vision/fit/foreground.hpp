// What stands before a stone and is no stone: legs from below, arms and brooms from above.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "vision/detect/stone_team.hpp"
#include "vision/fit/stone_patch.hpp"

namespace hogline::vision {

/// Somebody's leg is seen below a stone's foot, too, and goes up before it in its own colour; an arm comes down the
/// same way. In each column, which leans as what is upright does, so much is hidden as goes on in the colour that is
/// seen below the stone, or above its grip, where that is neither ice nor granite nor has a handle's hue.
class Foreground {
 public:
  /// By what it is told from a stone: by its own colour, which goes on beyond the stone's outline, or by not being a
  /// stone's.
  enum class By { run, unlike };

  /// Looks about `place` and what a stone there would cover, a little to all sides. `granite` is the club's.
  Foreground(const StonePicture& picture, const Eigen::Vector2d& place, const Light& granite, const TeamHues& teams,
             By by = By::run);

  By by() const { return by_; }

  /// Of the picture's pixels.
  bool hides(int x, int y) const;
  /// Share of the columns in which something is hidden.
  double share() const { return share_; }

 private:
  /// Of one column, from the row where it begins: how far the colour goes on. `step` is down or up the picture.
  int end_of_run(const PatchSource& source, int column, int from, int to, int step) const;

  /// By how many columns something upright is off in a row, against the middle row.
  int leaned(int y) const;
  bool is_like_granite(const Light& light) const;
  bool has_a_handles_hue(const Light& light) const;

  void find_runs(const StonePicture& picture, const Eigen::Vector2d& place);
  void find_unlike(const StonePicture& picture, const Eigen::Vector2d& place);

  By by_;
  Light granite_;
  TeamHues teams_;
  cv::Rect area_;
  double lean_ = 0.0;
  std::vector<int> above_;  ///< of each column: rows before it are hidden
  std::vector<int> below_;  ///< rows from it on are hidden
  cv::Mat unlike_;          ///< CV_8UC1 of the area: not 0 where something is hidden
  double share_ = 0.0;
};

}  // namespace hogline::vision
