// The pixels in which one stone's outline is seen, in linear light against white ice.
#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core/mat.hpp>

#include "vision/detect/stone_picture.hpp"
#include "vision/fit/stone_region.hpp"

namespace hogline::vision {

using Light = Eigen::Vector3d;  ///< blue, green, red; 1 is white ice

/// Light of each of a stone's pixels, channel by channel.
using PixelColours = Eigen::Array<float, Eigen::Dynamic, 3, Eigen::ColMajor, most_pixels, 3>;

/// The picture near a stone, against the white ice there.
class PatchSource {
 public:
  PatchSource(const StonePicture& picture, const Eigen::Vector2d& place);

  /// Of a pixel of the picture.
  Eigen::Array3f at(int x, int y) const { return padded(x, y).head<3>(); }
  /// The same and a zero.
  Eigen::Array4f padded(int x, int y) const {
    const std::uint8_t* p = bgr_->ptr<std::uint8_t>(y) + 3 * x;
    return level_[0][p[0]] + level_[1][p[1]] + level_[2][p[2]];
  }
  /// There is such a pixel.
  bool holds(int x, int y) const { return x >= 0 && y >= 0 && x < bgr_->cols && y < bgr_->rows; }
  /// Bilinear in linear light; false outside the picture.
  bool at(float x, float y, Eigen::Array3f& light) const;
  /// The mean of three such samples, one pixel apart in the direction of (step_x, step_y).
  bool mean_of_three(float x, float y, float step_x, float step_y, Eigen::Array3f& mean) const;

 private:
  bool nearest(float x, float y, Eigen::Array4f& light) const {
    if (!(x >= 0.0F && y >= 0.0F && x < last_x_ && y < last_y_)) return false;
    light = padded(static_cast<int>(x + 0.5F), static_cast<int>(y + 0.5F));
    return true;
  }
  bool sample(float x, float y, Eigen::Array4f& light) const {
    if (!(x >= 0.0F && y >= 0.0F && x < last_x_ && y < last_y_)) return false;
    const int column = static_cast<int>(x);
    const int row = static_cast<int>(y);
    const float u = x - static_cast<float>(column);
    const float v = y - static_cast<float>(row);
    Eigen::Array4f top = padded(column, row);
    Eigen::Array4f low = padded(column, row + 1);
    if (u > 0.0F) {
      top = top * (1.0F - u) + padded(column + 1, row) * u;
      low = low * (1.0F - u) + padded(column + 1, row + 1) * u;
    }
    light = top + v * (low - top);
    return true;
  }

  float last_x_;
  float last_y_;
  const cv::Mat* bgr_;
  std::array<std::array<Eigen::Array4f, 256>, 3>
      level_;  ///< of each channel, in its own place among zeros: to be added
};

struct StonePixels {
  SightLines sights;
  Pixels x, y;
  PixelColours light;
  PixelColours behind;  ///< what would be seen without the stone
  Pixels usable;        ///< 1: its background is known and nothing nearer hides it; else 0

  Eigen::Index count() const { return x.size(); }
};

/// Pixels on and about the outlines of handle and body, thinned to about `most`. None where the stone is not in the
/// picture.
void gather_stone_pixels(const PatchSource& source, const SheetCamera& camera, const StonePlace& stone, int most,
                         StonePixels& pixels);

/// Looks outward past the stone's outline for what is behind it. Pixels for which that can not be told are marked.
void look_behind(const PatchSource& source, const DiscDistances& handle, const BodyDistances& body,
                 StonePixels& pixels);

/// Marks pixels of the far rim over which something of the handle's colour is seen: its grip. What is behind is known.
/// `eye_m` is the camera's height.
void leave_out_grip(const PatchSource& source, const DiscDistances& handle, const BodyDistances& body, double eye_m,
                    const Light& handle_colour, StonePixels& pixels);

}  // namespace hogline::vision
