// The people about a simulated rink: they tidy the house as the rules say, put the robot back and lay the next stone
// before it. They also know what no robot is told: which stone lies where in truth.
#pragma once

#include <map>
#include <vector>

#include "hw/sim/team_rink.hpp"
#include "src/team/stone_names.hpp"

namespace hogline {

/// What a throw came to in truth.
struct TrueThrow {
  servo::ThrownStones stones;
  double margin_m = 1e9;  ///< least by which any stone is on the sheet, or off it
  bool released = false;
  servo::SlidingStone let_go;  ///< in s, when it was free; valid when released
};

class RinkCrew {
 public:
  /// The rink must outlive it.
  RinkCrew(hw::sim::TeamRink& rink, double sheet_width_m, double stone_radius_m);

  /// What the board does not have is taken off the sheet; what a throw that does not count has moved is put where it
  /// was before; the robot goes back, and this stone to it. Precondition: nothing moves.
  void prepare(const servo::Board& board, const StoneName& next);
  /// The stones of this board are on the sheet, and no others. Precondition: nothing has been thrown.
  void lay(const servo::Board& board);
  /// Once a control period.
  void watch();
  bool all_at_rest() const { return !rink_.stone_runs(); }
  /// The stone has left the hack.
  bool stone_is_gone() const { return rink_.thrown().has_value(); }
  /// Precondition: all at rest.
  TrueThrow truth() const;
  /// Where every stone lies in truth, also those that may not.
  servo::Board lying() const;

 private:
  struct Margins {
    double side_m = 1e9;
    double back_m = 1e9;
    bool out() const { return side_m < 0.0 || back_m < 0.0; }
  };
  void tidy(std::size_t number, const servo::Board& board);

  hw::sim::TeamRink& rink_;
  double half_width_m_;
  double radius_m_;
  StoneName next_;
  std::vector<std::optional<StoneName>> names_;  ///< by the numbers in the field; empty: taken off
  std::vector<Margins> margins_;
  std::map<std::size_t, servo::Place> before_;  ///< of the field's stones, in the skip's e, before the throw
  servo::SlidingStone let_go_;
};

}  // namespace hogline
