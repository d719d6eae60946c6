// Where in the far picture, at half its size, stones may be: places with as much granite as a stone's body shows, ice
// beside and below it, and no granite where the handle is. The size to expect follows from the picture's row.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "vision/detect/stone_outline.hpp"
#include "vision/detect/stone_picture.hpp"

namespace hogline::vision {

/// A place where a handle's centre may be.
struct FarPlace {
  cv::Point2d pixel;           ///< of the picture that was scanned
  double half_width_px = 0.0;  ///< of the stone's body there
  double range_m = 0.0;        ///< from the camera
  float score = 0.0F;          ///< at most 1
};

/// Keeps its memory from picture to picture.
class FarScan {
 public:
  /// By falling score, at most `most_places`. They stay until the next call. Only handles in the rows of `part`, the
  /// part's number and how many there are, from the farthest down.
  struct Part {
    int number = 0;
    int count = 1;
    int parts = 1;  ///< so many of them, from this one on
  };
  /// `twice` is the same picture at twice its size: of `picture`, which need not be there, only the size counts.
  const std::vector<FarPlace>& find(const StonePicture& picture, const cv::Mat& twice, const StoneArea& area,
                                    const Part& part);

  static constexpr std::size_t most_places = 40;

 private:
  static constexpr int step_px = 2;
  static constexpr int margin = 64;  ///< steps beside the picture, without granite

  /// A stone whose handle's centre is in a row, relative to it, in steps.
  struct Row {
    bool seen = false;
    double half_width_px = 0.0;
    double range_m = 0.0;
    int half_width = 0;
    int granite_top = 0;  ///< below the handle
    int foot = 0;
    int above = 0;  ///< the grip's top, negative
    int first = 0;  ///< columns that are of this sheet
    int last = 0;
  };
  static constexpr int planned_together = 4;
  void plan_rows(const StonePicture& picture, const StoneArea& area, const Part& part);
  Row plan_row(const StonePicture& picture, const StoneArea& area, int y) const;
  void find_granite(const StonePicture& picture, const cv::Mat& twice);
  float score(const Row& row, int c, int r) const;
  float share(int left, int top, int right, int bottom) const;

  std::vector<Row> rows_;
  int first_row_ = 0;  ///< of those in which handles are looked for
  int last_row_ = 0;   ///< and the one after them
  int base_row_ = 0;   ///< the first row of `granite_`
  cv::Mat granite_;
  cv::Mat sums_;
  cv::Mat scores_;
  std::vector<FarPlace> places_;
};

/// For the votes: marks where a place's handle's centre is looked for, and says where that is. `centre` and
/// `half_width_px` are in pixels of the picture voted on, `centres` is half its size.
cv::Rect mark_for_votes(cv::Point2d centre, double half_width_px, cv::Mat& centres);

}  // namespace hogline::vision
