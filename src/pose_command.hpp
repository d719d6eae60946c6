// `hogline pose`: the sheet's pose from pictures.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace hogline {

struct PoseOptions {
  std::string rig;
  std::string camera;               ///< near or low
  bool sequence = false;            ///< the pictures are consecutive frames
  std::optional<double> rate_hz;    ///< of the sequence; 60, or a video's own
  std::optional<std::string> draw;  ///< a folder for pictures with what was seen drawn on them; nothing: none
  std::vector<std::string> images;
};

/// Prints one JSON object a line on stdout. 0: all estimated, 1: some not. Throws ConfigError for wrong use.
int run_pose(const PoseOptions& options);

}  // namespace hogline
