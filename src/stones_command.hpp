// `hogline stones`: the stones on the sheet from pictures of the near camera.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace hogline {

struct StonesOptions {
  std::string rig;
  std::optional<std::string> draw;  ///< a folder for pictures with what was seen drawn on them; nothing: none
  bool sequence = false;            ///< the pictures are of one robot that stands still: their stones are averaged
  std::vector<std::string> images;
};

/// Prints one JSON object a line on stdout. 0: all estimated, 1: some not. Throws ConfigError for wrong use.
int run_stones(const StonesOptions& options);

}  // namespace hogline
