// One sheet of ice between a thrower's and a skip's simulated rink, and a person who tidies it between the throws.
#pragma once

#include <cstdint>

#include "hw/sim/rink.hpp"
#include "hw/sim/skip_rink.hpp"

namespace hogline::hw::sim {

/// The same place or motion seen from the other end: e of the thrower to e of the skip, and back.
StoneTruth from_other_end(const StoneTruth& stone);

/// Couples two rinks that begin at the same moment: their clocks go on together, and all stones on the ice are the
/// skip's field. What the thrower's jaws let go is handed to it at the end of the millisecond in which it became free,
/// as it is then; from there on the thrower's world is told where it runs, and where the others lie. A stone in the
/// jaws, or set down in the hack, is the thrower's alone. The same configuration and programs give the same bytes.
class TeamRink {
 public:
  /// Both must outlive it. `seed` draws what differs from throw to throw. Precondition: both are at the same moment.
  TeamRink(Rink& thrower, SkipRink& skip, const RobotScenario& robot, std::uint64_t seed);

  /// Advances both. Precondition: span > 0.
  void step(Duration span);
  Stamp now() const { return thrower_.now(); }

  /// The next throw begins: a person puts the robot back where the scenario has it start, within 5 cm and 2 degrees,
  /// and lays a stone of this team before it in the hack (jaws that are open must then be closed; a stone that is still
  /// held stays the one it is). The ice has this throw's friction. Precondition: the robot stands and nothing runs.
  void put_back(int team);

  /// A stone that has been let go and still moves.
  bool stone_runs() const;
  /// Number in the skip's field of the stone let go since the last put_back().
  std::optional<std::size_t> thrown() const { return skip_.thrown(); }
  const StoneField& field() const { return skip_.field(); }
  /// A person's hand.
  void lay(const FieldStone& stone) { skip_.field().add(stone); }
  void take_off(std::size_t number) { skip_.field().take_off(number); }
  void take_all_off() { skip_.take_all_off(); }  ///< their numbers begin anew
  void put(std::size_t number, double x_m, double y_m) { skip_.field().put(number, x_m, y_m); }

 private:
  void substep(Duration span);
  SheetStones sheet_stones() const;

  Rink& thrower_;
  SkipRink& skip_;
  RobotScenario robot_;
  std::uint64_t seed_;
  std::uint64_t throws_ = 0;
  int team_ = 0;
};

}  // namespace hogline::hw::sim
