// A random board in which something happens: one stone is struck and runs until it stops short of the next one, and
// somebody walks through the view. Pictures at a rate, each with its own noise, rendered by hw/sim.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hw/sim/sheet_renderer.hpp"
#include "tests/support/random_board.hpp"
#include "vision/percepts/stones.hpp"
#include "vision/stone_sequence.hpp"

namespace hogline::vision::testing {

struct Happenings {
  double rate_hz = 30.0;
  int struck_at = 6;       ///< picture after which the stone runs; negative: none does
  double speed_mps = 1.5;  ///< at first
  bool walker = true;
};

class MovingBoard {
 public:
  MovingBoard(std::uint64_t seed, const Happenings& what);

  const hogline::testing::RandomBoard& board() const { return board_; }
  StonesSetup setup() const;
  Stamp stamp(int k) const;
  /// The stone that is struck; nothing where there is none or no room.
  std::optional<std::size_t> struck() const { return struck_; }
  /// Truth of picture k; what is in sight is worked out where it is asked for.
  hogline::testing::RandomBoard at(int k, bool with_sight) const;
  cv::Mat picture(int k) const;

 private:
  double way_m(double t_s) const;

  Happenings what_;
  hogline::testing::RandomBoard board_;
  hw::sim::SheetRenderer renderer_;
  std::optional<std::size_t> struck_;
  double direction_rad_ = 0.0;
  double room_m_ = 0.0;
};

struct SequenceScore {
  int looks = 0;
  int stones = 0;  ///< that can be asked for, over all looks
  int found = 0;
  int ghosts = 0;
  int struck = 0;  ///< looks at the struck stone while it runs or after
  int struck_found = 0;
  double square_m2 = 0.0;
  std::vector<std::string> failures;

  void add(std::uint64_t seed, int k, const hogline::testing::RandomBoard& truth, std::optional<std::size_t> struck,
           const StonesPercept& seen);
  double rms_m() const;
  std::string words() const;
};

}  // namespace hogline::vision::testing
