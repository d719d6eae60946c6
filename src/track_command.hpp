// `hogline track`: a recorded throw, followed as the skip follows a live one.
#pragma once

#include <string>

namespace hogline {

struct TrackOptions {
  std::string rig;
  std::string folder;  ///< near.csv, far.csv, head.csv and the pictures
  std::string at;      ///< X_M,Y_M,YAW_DEG of the body; empty: the near view measures it
  std::string ice;     ///< file, read if it is there and written afterwards; empty: none
  double spin_radps = 0.0;
  std::string out = "out/track";
};

/// Throws ConfigError for wrong use.
int run_track(const TrackOptions& options);

}  // namespace hogline
