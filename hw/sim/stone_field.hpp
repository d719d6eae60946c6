// Stones on the skip's end of the sheet: they slide, meet and part, and who goes out is taken off. Frame e of the skip.
#pragma once

#include <vector>

#include "hw/sim/scenario.hpp"
#include "hw/sim/truth.hpp"

namespace hogline::hw::sim {

struct FieldStone {
  StoneTruth motion;
  int team = 0;            ///< 0 or 1: the rig's first or second
  bool taken_off = false;  ///< it was out and somebody caught it; then it is nowhere
};

/// Two stones that met: by their numbers in the field.
struct StoneContact {
  Stamp stamp{};
  int striker = 0;  ///< the faster one
  int struck = 0;
  double struck_mps = 0.0;  ///< its speed afterwards
};

/// Moves in steps of at most a millisecond. The friction of the throw is the scenario's with one draw of its scatter.
class StoneField {
 public:
  StoneField(const StoneScenario& scenario, double sheet_width_m, std::vector<FieldStone> standing, std::uint64_t seed,
             Stamp start);

  /// Puts one more stone on the ice, running or not. Returns its number.
  int add(const FieldStone& stone);
  /// A person's hand: takes a stone off the sheet, or puts one down at rest.
  void take_off(std::size_t number);
  void put(std::size_t number, double x_m, double y_m);
  void take_all_off() { stones_.clear(), contacts_.clear(); }
  /// Another throw begins: its own friction, and no contacts yet.
  void begin_throw(std::uint64_t seed);
  /// Precondition: `until` is not before now().
  void step(Stamp until);

  Stamp now() const { return now_; }
  const std::vector<FieldStone>& stones() const { return stones_; }
  const std::vector<StoneContact>& contacts() const { return contacts_; }
  bool at_rest() const;
  /// With the throw's own friction.
  const StoneScenario& ice() const { return scenario_; }

 private:
  void slide_all(double dt_s);
  void collide_all();
  void catch_those_out();

  StoneScenario scenario_;
  double friction_scale_;  ///< of the session
  double sheet_width_m_;
  std::vector<FieldStone> stones_;
  std::vector<StoneContact> contacts_;
  Stamp now_;
};

}  // namespace hogline::hw::sim
