// The outline that a stone has in one part of the picture: where edges must be for a stone to stand there.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <deque>
#include <opencv2/core/types.hpp>
#include <vector>

#include "vision/geometry/sheet_camera.hpp"
#include "vision/geometry/stone_shape.hpp"

namespace hogline::vision {

/// Where on the sheet stones are looked for, in e.
struct StoneArea {
  double half_width_m = 2.7;
  double min_y_m = -4.0;
  double max_y_m = 7.0;
  bool contains(const Eigen::Vector2d& place) const {
    return std::abs(place.x()) <= half_width_m && place.y() >= min_y_m && place.y() <= max_y_m;
  }
  StoneArea wider(double by_m) const { return {half_width_m + by_m, min_y_m - by_m, max_y_m + by_m}; }
};

/// A place of an outline relative to the handle's centre, in pixels, with the outline's unit normal there.
struct OutlineMark {
  float x, y, normal_x, normal_y;
};

/// The handle's near edge lies lower by its thickness, which is only roughly known: one mark each for a thin, a
/// middling and a thick one, the best counts.
struct StoneOutline {
  static constexpr std::size_t handle_marks = 8;
  static constexpr std::size_t body_marks = 13;
  bool seen = false;
  std::array<OutlineMark, handle_marks> far_rim;
  std::array<std::array<OutlineMark, 3>, handle_marks> near_edge;
  std::array<OutlineMark, body_marks> body;
  static constexpr std::size_t first_body_marks = 5;
  static constexpr std::size_t first_handle_marks = 6;
  std::array<OutlineMark, first_body_marks> first_body;  ///< some of these
  std::array<OutlineMark, first_handle_marks> first_handle;
  float half_width_px = 0.0F;  ///< of the handle's outline
  float half_depth_px = 0.0F;
  float removal_x = 0.0F;  ///< half axes of the ellipse in which no other stone's centre is looked for
  float removal_y = 0.0F;
};

/// Outlines change slowly over the picture: one for each block, made when it is first asked for. Keeps its memory.
class OutlineTable {
 public:
  /// Takes up a camera's pose; the references are kept until the next one.
  void begin(const SheetCamera& camera, const StoneShape& shape, const StoneArea& area);

  const StoneOutline& at(int x, int y) {
    const auto i = static_cast<std::size_t>(y / block_px * columns_ + x / block_px);
    if (outlines_[i] == nullptr)
      outlines_[i] = make({(x / block_px + 0.5) * block_px, (y / block_px + 0.5) * block_px});
    return *outlines_[i];
  }

  /// Where the next outline begins, to the right; a multiple of two.
  static int next_column(int x) { return (x / block_px + 1) * block_px; }

 private:
  static constexpr int block_px = 24;

  const StoneOutline* make(const Eigen::Vector2d& pixel);
  bool draw(const Eigen::Vector2d& pixel, StoneOutline& outline) const;

  const SheetCamera* camera_ = nullptr;
  const StoneShape* shape_ = nullptr;
  StoneArea area_;
  int columns_ = 0;
  std::vector<const StoneOutline*> outlines_;
  std::deque<StoneOutline> memory_;
  std::size_t used_ = 0;
};

}  // namespace hogline::vision
