// What truly happens on the simulated rink, as lines of JSON in a file: what programs that were killed or misled can
// not say of themselves.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hw/sim/stone_field.hpp"
#include "hw/sim/truth.hpp"
#include "src/live/line_writer.hpp"

namespace hogline {

/// Written by a thread of its own: a program that is killed loses its last tens of milliseconds. A sample every 5 ms
/// while anything of the robot moves, and whenever what holds or lets go changes; every 0.2 s otherwise.
/// doc/programs.md has the keys.
class TruthLog {
 public:
  /// Appends; an empty path writes nothing. Throws ConfigError that names --truth.
  explicit TruthLog(const std::string& path);
  TruthLog(const TruthLog&) = delete;
  TruthLog& operator=(const TruthLog&) = delete;

  /// The rink begins anew.
  void start(Stamp now);
  /// `now`: the truth's moment, in the steady clock.
  void sample(const hw::sim::Truth& truth, Stamp now);
  /// Every stone has come to rest: where those on the sheet lie, the thrown one by its number among them (e of the
  /// skip).
  void at_rest(const std::vector<hw::sim::FieldStone>& stones, std::optional<std::size_t> thrown, Stamp now);

  /// A line could not be written: a full disk, for instance.
  bool lost() const { return lines_.lost(); }
  /// Whether every line is written, once no more will come.
  bool flush() { return lines_.flush(); }

 private:
  struct File {
    explicit File(const std::string& path);
    ~File();
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    int descriptor = -1;
  };

  File file_;
  LineWriter lines_;  // after it: it writes what is left when it goes
  Stamp last_{};
  bool last_held_ = false;
  bool last_released_ = false;
  double last_arm_ = 0.0;
};

/// Body, wheels or arm of the robot move.
bool robot_moves(const hw::sim::Truth& truth);

}  // namespace hogline
