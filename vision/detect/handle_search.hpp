// Handles behind stones that are known: where two or three stand in a row, of the farther ones often nothing but the
// plate is seen, over and between the nearer ones' plates and grips.
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "vision/detect/known_stone.hpp"
#include "vision/detect/stone_picture.hpp"
#include "vision/detect/stone_vote.hpp"

namespace hogline::vision {

class HandleSearch {
 public:
  /// Places behind the stones of `nearer` at which what the known ones leave free of a plate has the colour of one of
  /// their handles, and what is beside it has not. By falling likeness; they stay until the next call.
  const std::vector<StoneCandidate>& find(const StonePicture& picture, const std::vector<KnownStone>& known,
                                          const std::vector<KnownStone>& nearer);

 private:
  /// Where a plate's pixels are, and those beside it that must not look like one; relative to its centre.
  struct Template {
    std::vector<cv::Point> plate, beside;
    std::vector<cv::Point> few;  ///< of the plate's: where these are not alike the rest is not worth asking
    int reach_px = 0;
    int step_px = 1;
  };
  struct Peak {
    int x, y;
    float likeness;
  };

  Template draw(const StonePicture& picture, const Eigen::Vector2d& place) const;
  bool draw_outlines(const StonePicture& picture, const Eigen::Vector2d& place);
  void cover(const StonePicture& picture, const std::vector<KnownStone>& known);
  void choose_colours(const std::vector<KnownStone>& known);
  void paint_likeness(const StonePicture& picture, const Eigen::Vector3d& colour);
  cv::Rect window_behind(const StonePicture& picture, const Eigen::Vector2d& nearer);
  void search(const StonePicture& picture, const cv::Rect& window, const std::vector<KnownStone>& known);
  float mean(const std::vector<cv::Point>& points, int x, int y, float range_m, int& seen) const;
  float likeness(const Template& handle, int x, int y, float range_m) const;

  cv::Rect area_;     ///< of the picture: what the two below cover
  cv::Mat range_;     ///< CV_32F: of the nearest known stone that covers a pixel, else far
  cv::Mat likeness_;  ///< CV_32F: how much a pixel is like a handle's colour, 0..1
  Template handle_;
  std::vector<cv::Point> body_, plate_;
  std::vector<Eigen::Vector3d> colours_;
  std::vector<Peak> peaks_;
  std::vector<StoneCandidate> candidates_;
};

}  // namespace hogline::vision
