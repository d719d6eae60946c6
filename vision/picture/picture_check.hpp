// Whether a picture can show anything at all: not black, not washed out, not the same one again.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

namespace hogline::vision {

enum class PictureFault {
  black,      ///< dark all over and without structure: lens covered, iris shut, exposure lost, hall dark
  saturated,  ///< nearly every pixel at the sensor's end: exposure or gain run away
  frozen,     ///< byte for byte the picture before: a live sensor has noise
};

const char* to_string(PictureFault fault);

/// Levels are shares of full scale in the picture's own response curve. Rendered and real sheets, in dim light too, are
/// far away from all of them: 2 to 98 % of their blocks span a third of the scale, and 0.4 % of their samples are at
/// its end (68 scenes, 2026-11).
struct PictureLimits {
  double dark_level = 0.10;       ///< black: 98 % of the picture's blocks are darker than this,
  double flat_range = 0.02;       ///< and differ by no more than this
  double bright_level = 0.98;     ///< saturated: at least
  double saturated_share = 0.90;  ///< this share of the samples is at this level or above
};

struct PictureVerdict {
  std::optional<PictureFault> fault;
  double dark_block = 0.0;    ///< level under which 2 % of the blocks lie
  double bright_block = 0.0;  ///< level under which 98 % of the blocks lie
  double saturated_share = 0.0;

  /// What was seen, for a person: "black: the whole picture lies at 0.4 % to 0.5 % of full scale".
  std::string describe() const;
};

/// Looks at one row in eight, so that a 2 megapixel picture takes less than a millisecond. Remembers those rows of
/// the picture before.
class PictureCheck {
 public:
  explicit PictureCheck(const PictureLimits& limits = {}) : limits_(limits) {}

  /// Precondition: CV_8UC1 or CV_8UC3, not empty.
  PictureVerdict check(const cv::Mat& picture);
  /// The next picture has no predecessor.
  void forget() { last_rows_.release(); }

 private:
  PictureLimits limits_;
  cv::Mat last_rows_;
};

}  // namespace hogline::vision
