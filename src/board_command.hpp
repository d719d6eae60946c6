// `hogline board`: what lies on the sheet under the rules, printed and drawn.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace hogline {

struct BoardOptions {
  std::string rig;
  std::optional<std::string> out;  ///< folder for the drawing; nothing: none
  std::vector<std::string> images;
};

/// The pictures are of one robot that stands still: their stones are averaged. 0: seen, 1: not. Throws ConfigError.
int run_board(const BoardOptions& options);

}  // namespace hogline
