// The pictures a command is given, one after the other: files by name, or a recording with its own times.
#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vision/percepts/stamp.hpp"

namespace hogline {

struct Picture {
  std::string name;     ///< "run-002.jpg"; of a video "run.mp4#2", from 0
  cv::Mat bgr;          ///< empty: `problem` says why
  Stamp stamp{};        ///< after the beginning of the sequence
  std::string problem;  ///< it can not be read, or another camera took it: nothing can be estimated
};

/// The next picture, or nothing at the end.
using PictureReader = std::function<std::optional<Picture>()>;

/// `names` are JPEG or PNG files at a steady rate, or one recording: a folder of them, a stamps file (.csv: a first
/// line name,id,time_s, then one line a picture) or a video. Without `rate_hz` it is 60 a second, and a video's own.
/// Throws ConfigError at once when something is not there or is none of these.
PictureReader read_pictures(const std::vector<std::string>& names, cv::Size size, std::optional<double> rate_hz);

}  // namespace hogline
