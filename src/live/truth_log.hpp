// What truly happens on the simulated rink, as lines of JSON in a file: what programs that were killed or misled can
// not say of themselves.
#pragma once

#include <string>

#include "hw/sim/truth.hpp"

namespace hogline {

/// Each line is handed to the kernel whole: a program that is killed loses none that it wrote. A sample every 5 ms
/// while anything of the robot moves, and whenever what holds or lets go changes; every 0.2 s otherwise.
/// doc/programs.md has the keys.
class TruthLog {
 public:
  /// Appends; an empty path writes nothing. Throws std::runtime_error.
  explicit TruthLog(const std::string& path);
  ~TruthLog();
  TruthLog(const TruthLog&) = delete;
  TruthLog& operator=(const TruthLog&) = delete;

  /// The rink begins anew.
  void start(Stamp now);
  void sample(const hw::sim::Truth& truth);

 private:
  void write(const std::string& line) const;

  int file_ = -1;
  Stamp last_{};
  bool last_held_ = false;
  bool last_released_ = false;
  double last_arm_ = 0.0;
};

/// Body, wheels or arm of the robot move.
bool robot_moves(const hw::sim::Truth& truth);

}  // namespace hogline
