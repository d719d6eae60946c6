// A drawing goes to a file named after the picture that it was drawn on.
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

namespace hogline {

/// As FOLDER/NAME.png; of a recording's frame the name keeps its number. Throws std::runtime_error.
void save_drawing(const std::string& folder, const std::string& picture, const cv::Mat& drawing);

}  // namespace hogline
