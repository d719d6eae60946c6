// `hogline stones`: the stones on the sheet from pictures of the near camera, or down the sheet from the far camera's.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace hogline {

struct StonesOptions {
  std::string rig;
  std::string camera = "near";      ///< near or far
  std::optional<std::string> at;    ///< the body's pose in e for the far camera: "X_M,Y_M,YAW_DEG"
  std::optional<std::string> draw;  ///< a folder for pictures with what was seen drawn on them; nothing: none
  bool sequence = false;            ///< the pictures are of one robot that stands still: their stones are averaged
  std::vector<std::string> images;
};

/// Prints one JSON object a line on stdout. 0: all estimated, 1: some not. Throws ConfigError for wrong use.
int run_stones(const StonesOptions& options);

}  // namespace hogline
