// Drawings go to files named after the pictures that they were drawn on.
#pragma once

#include <map>
#include <opencv2/core/mat.hpp>
#include <string>

namespace hogline {

/// The folder that one run draws into.
class DrawingFolder {
 public:
  /// Makes the folder that `option` names. Throws ConfigError where nothing can be written into it.
  DrawingFolder(const std::string& option, const std::string& folder);

  /// As FOLDER/NAME.png; of a recording's frame the name keeps its number. Where another picture of this run has taken
  /// the name, the picture's own folder goes before it, and after that a number follows it. Throws std::runtime_error.
  /// Returns the file's path.
  std::string save(const std::string& picture, const cv::Mat& drawing);

 private:
  std::string name_for(const std::string& picture);

  std::string folder_;
  std::map<std::string, std::string> taken_;  ///< name to picture
};

}  // namespace hogline
