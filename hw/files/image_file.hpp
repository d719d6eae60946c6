// One recorded picture from a file, or why it can not be used.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

namespace hogline::hw::files {

enum class ImageErrorKind {
  missing,       ///< no such file, or a directory
  unreadable,    ///< no permission, or the disk fails
  not_an_image,  ///< neither JPEG nor PNG inside, whatever its name says
  truncated,     ///< the file ends early
  damaged,       ///< its end is there, but not all between makes sense
  wrong_size,    ///< not the rig's width and height
  wrong_format,  ///< not 8-bit colour
};

struct ImageError {
  ImageErrorKind kind = ImageErrorKind::missing;
  std::string path;
  std::string what;  ///< one line: what is wrong and what to do about it

  /// "PATH: what".
  std::string message() const { return path + ": " + what; }
};

/// Either a picture or an error.
struct LoadedImage {
  cv::Mat bgr;  ///< CV_8UC3, as the sensor read it out: no turning by a camera's orientation tag
  std::optional<ImageError> error;
};

/// Strict: a picture is loaded whole and as it is, or not at all. `size` is what the rig file says of the camera.
LoadedImage load_image(const std::string& path, cv::Size size);

}  // namespace hogline::hw::files
