// Drawings and pictures to PNG files.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

namespace hogline::hw::files {

/// Writes an 8-bit picture, making the folders above it. Returns one line that names the file and what went wrong, or
/// nothing when the file is complete on the disk. The same picture gives the same bytes.
std::optional<std::string> write_png(const std::string& path, const cv::Mat& picture);

}  // namespace hogline::hw::files
