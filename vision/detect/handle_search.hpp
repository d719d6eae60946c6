// Handles behind stones that are known: where two or three stand in a row, of the farther ones often nothing but the
// plate is seen, over and between the nearer ones' plates and grips.
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "vision/detect/stone_picture.hpp"
#include "vision/detect/stone_vote.hpp"

namespace hogline::vision {

/// A stone that is known already.
struct KnownStone {
  Eigen::Vector2d place;   ///< in e
  Eigen::Vector3d handle;  ///< its colour against white ice: blue, green, red
};

class HandleSearch {
 public:
  /// Places behind the known stones at which what the nearer ones leave free of a plate has the colour of one of them,
  /// and what surrounds it has not. By falling likeness; they stay until the next call.
  const std::vector<StoneCandidate>& find(const StonePicture& picture, const std::vector<KnownStone>& known);

 private:
  /// Where a plate's pixels are, and those beside it that must not look like one; relative to its centre.
  struct Template {
    std::vector<cv::Point2f> plate, beside;
  };
  struct Peak {
    float x, y, likeness;
  };

  Template draw(const StonePicture& picture, const Eigen::Vector2d& place) const;
  void cover(const StonePicture& picture, const std::vector<KnownStone>& known, const cv::Rect& area);
  void paint_likeness(const StonePicture& picture, const Eigen::Vector3d& colour, const cv::Rect& area);
  float likeness(const Template& handle, float x, float y, float range_m) const;
  void search(const StonePicture& picture, const KnownStone& nearer, const std::vector<KnownStone>& known);

  cv::Rect area_;
  cv::Mat range_;     ///< CV_32F: of the nearest known stone that covers a pixel, else far
  cv::Mat likeness_;  ///< CV_32F: how much a pixel is like the handle's colour, 0..1; negative: it may be a grip
  std::vector<Peak> peaks_;
  std::vector<StoneCandidate> candidates_;
};

}  // namespace hogline::vision
