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

  /// Takes up a picture, from row `top` down, and how the camera looked at it; it is used until the next one. The
  /// smaller ones are made as a whole, and white ice is looked at.
  void begin(const cv::Mat& bgr, int top, const ResponseCurve& response, const Pose& eMc, const Ice& ice);

  /// The same, but white ice is as it was, and of the smaller ones there is only what fill() asks for.
  /// Precondition: begin() before.
  void go_on(const cv::Mat& bgr, const Pose& eMc, const Ice& ice);
  void fill(int level, const cv::Rect& area);

  /// Half the size: fine enough to search all of it.
  const FarLevel& middle() const { return levels_[1]; }
  const FarLevel& operator[](int i) const { return levels_[static_cast<std::size_t>(i)]; }

  /// Which one to look at for stones at a range: 0 is the whole size.
  static int level_at(double range_m, const Intrinsics& intrinsics);

 private:
  void look_from(const Pose& eMc, const Ice& ice);

  std::array<FarLevel, count> levels_;
  bool whole_ = false;  ///< nothing is left to fill
};

}  // namespace hogline::vision
