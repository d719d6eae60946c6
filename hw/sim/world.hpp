// The robot, and the stone it holds or has let go.
#pragma once

#include "hw/sim/robot_dynamics.hpp"
#include "hw/sim/scenario.hpp"
#include "hw/sim/truth.hpp"

namespace hogline::hw::sim {

/// What the devices do to the world.
struct WorldInputs {
  AxisSpeeds axes;
  double belt_radps = 0.0;             ///< of the held stone, in the body
  std::optional<Stamp> stone_free_at;  ///< when the jaws let the stone go; may lie in the future
  bool stone_in_jaws = false;          ///< the jaws are closed on it
  double arm_unfolded = 0.0;
};

/// The stones of a sheet that is moved elsewhere (TeamRink), in e.
struct SheetStones {
  std::optional<StoneTruth> thrown;  ///< the one that was let go last, from when the sheet has it
  std::vector<StoneTruth> others;
  std::vector<int> other_teams;
};

/// Steps of at most a millisecond; the step in which the stone becomes free is cut at that moment. Touching the stone
/// afterwards is recorded; the push itself is not simulated.
class World {
 public:
  World(const Scenario& scenario, Stamp start);

  /// Moves the world from where it is to `until`.
  void step(const WorldInputs& inputs, Stamp until);
  const Truth& truth() const { return truth_; }
  /// A stone stands, at rest against the body, where it was held: closing jaws grip it.
  bool stone_between_jaws() const;

  /// From now on what has been let go slides elsewhere: this is where it is, and where all other stones are. A stone
  /// that was let go within the last step goes on here until the sheet has it.
  void stones_are(const SheetStones& sheet);
  /// A person sets the robot down at this pose and a stone of this team before it, between its jaws where they are
  /// open; jaws that still hold a stone keep it. Precondition: the robot stands.
  void put_back(const PlanarPose& body, int team, double handle_rad);

  /// Lets every stone that slides come to rest, in no time: nothing else moves, no time passes.
  void settle();

 private:
  void substep(const WorldInputs& inputs, Duration span);
  void release();
  void grip_again(const WorldInputs& inputs);
  struct Offset {
    double ahead_m = 0.0;
    double left_m = 0.0;
  };
  Offset from_jaws() const;  // of the stone, from where it is held
  void carry(double belt_radps);
  void slide_stones(double dt_s);
  void detect_touch();

  StoneScenario stone_;
  RobotDynamics robot_;
  Truth truth_;
  bool slides_elsewhere_ = false;  ///< the released stone
};

}  // namespace hogline::hw::sim
