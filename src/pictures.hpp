// The pictures that a command is given and those that it draws.
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "hw/files/image_file.hpp"
#include "vision/geometry/lens.hpp"

namespace hogline {

/// Throws ConfigError where one of them is no file.
void check_pictures_exist(const std::vector<std::string>& paths);

/// A picture that is none is wrong use (ConfigError); one that another camera took is a picture in which nothing can be
/// estimated (its `error` is set).
hw::files::LoadedImage read_picture(const std::string& path, const vision::Intrinsics& camera);

/// As FOLDER/NAME.png, with the name of the picture that it was drawn on. Throws std::runtime_error.
void save_drawing(const std::string& folder, const std::string& picture, const cv::Mat& drawing);

}  // namespace hogline
