// The far picture at three sizes. A stone is 200 pixels wide at 8 m and 50 at 30 m, and what no rule says of its shape
// (the handle's thickness, the body's curve) is many pixels of a near one: each stone is looked at where it is about as
// large as in the near view, for which search and fit are made.
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "vision/camera_setup.hpp"
#include "vision/detect/stone_picture.hpp"

namespace hogline::vision {

/// One size of the picture, and the camera that would have taken it.
struct FarLevel {
  int scale = 1;  ///< the whole picture is so many times larger
  cv::Mat bgr;
  std::optional<Lens> lens;
  std::optional<SheetCamera> camera;
  std::optional<WhiteLight> ice;

  StonePicture picture(const ResponseCurve& response, const StoneShape& shape) const {
    return {bgr, response, *ice, *camera, shape};
  }
};

/// Keeps its memory from picture to picture.
class FarLevels {
 public:
  static constexpr int count = 3;

  explicit FarLevels(const Intrinsics& intrinsics);

  /// Takes up a picture, from row `top` down, and how the camera looked at it; it is used until the next one.
  void begin(const cv::Mat& bgr, int top, const ResponseCurve& response, const Pose& eMc, const Ice& ice);

  /// Half the size: fine enough to search all of it.
  const FarLevel& middle() const { return levels_[1]; }
  const FarLevel& operator[](int i) const { return levels_[static_cast<std::size_t>(i)]; }

  /// Which one to look at for stones at a range: 0 is the whole size.
  static int level_at(double range_m, const Intrinsics& intrinsics);

 private:
  std::array<FarLevel, count> levels_;
};

}  // namespace hogline::vision
