// What goes along with a simulated throw, however its time passes: the fault that strikes, the judge, the log.
#pragma once

#include "src/throwing/simulated_throw.hpp"
#include "src/throwing/throw_judge.hpp"

namespace hogline {

class ThrowRecorder {
 public:
  ThrowRecorder(const ThrowRequest& request, SimulatedRobot& robot, Stamp start);

  /// Before and after each step of the loop.
  void before(Stamp now, const servo::Thrower& thrower);
  void after(Stamp now, const servo::Thrower& thrower, const Progress& progress);
  /// The robot has come to its end, or had time enough to.
  bool robot_done(Stamp now, const servo::Thrower& thrower) const;
  bool stone_slides(Stamp now) const;
  ThrowOutcome outcome(const ThrowerLoop& loop, const VisionSeer& vision);

 private:
  const ThrowRequest& request_;
  SimulatedRobot& robot_;
  Stamp start_;
  ThrowJudge judge_;
  ThrowLog log_;
  bool fault_waits_;
};

}  // namespace hogline
