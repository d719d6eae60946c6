// What was seen, drawn on the picture in which it was seen.
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

#include "vision/low_view.hpp"
#include "vision/near_view.hpp"
#include "vision/percepts/sheet_pose.hpp"

namespace hogline::drawing {

/// Candidates of the three lines, the ring's contour, the four points, the painted sheet where the estimate puts it,
/// and the pose in words. A percept that is not ok gets its reason instead of a pose. `picture` is CV_8UC3 or CV_8UC1.
cv::Mat draw_near_view(const cv::Mat& picture, const SheetPosePercept& percept, const vision::NearViewSketch& sketch,
                       const std::string& title = "near view");

/// Candidates, the chosen H, the painted sheet, the pose in words.
cv::Mat draw_low_view(const cv::Mat& picture, const SheetPosePercept& percept, const vision::LowViewSketch& sketch,
                      const std::string& title = "low view");

}  // namespace hogline::drawing
