// Several pictures on one page.
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace hogline::drawing {

/// A picture and the line under it; an empty picture is left out.
struct Panel {
  cv::Mat picture;  ///< CV_8UC3
  std::string caption;
};

/// Rows of panels on white, each row as wide as the page: its panels share its height and keep their shapes.
/// Precondition: page_width_px >= 200.
cv::Mat draw_contact_sheet(const std::vector<std::vector<Panel>>& rows, int page_width_px);

}  // namespace hogline::drawing
