// One throw on the simulated rink, from start to standstill, judged against the simulator's truth.
#pragma once

#include <functional>
#include <optional>

#include "src/throwing/fault.hpp"
#include "src/throwing/oracle_seer.hpp"
#include "src/throwing/simulated_robot.hpp"
#include "src/throwing/throw_log.hpp"
#include "src/throwing/throw_result.hpp"
#include "src/throwing/thrower_loop.hpp"
#include "src/throwing/vision_seer.hpp"
#include "src/throwing/watched_seer.hpp"

namespace hogline {

/// What stands behind the percepts: the pictures themselves, or the simulator's truth with vision's errors
/// (OracleSeer).
enum class Eyes { vision, oracle };

struct ThrowRequest {
  config::ThrowerRig rig;
  hw::sim::Scenario scenario;
  servo::ShotOrder order;
  std::optional<Fault> fault;
  Eyes eyes = Eyes::vision;
  bool low_by_lines = false;  ///< vision's low view is plain vpMeLine's (LineSeer), to compare with
  bool follow_stone = true;   ///< go on until the released stone lies still
  bool settle = false;        ///< ... but do not simulate the robot meanwhile: the log ends with the robot's throw
  int render_threads = 2;
  LookWatch watch{};  ///< told of every look, beside the truth
};

/// What there is to show of a throw.
struct ThrowOutcome {
  ThrowResult result;
  ThrowLog log;
  std::optional<Sight<vision::NearViewSketch>> near_sight;
  std::optional<Sight<vision::LowViewSketch>> low_sight;
};

/// Called now and then with the simulated time and the state.
using Progress = std::function<void(double t_s, servo::ThrowerState state)>;

/// The same rig with cameras of a sixteenth of the width and height: enough for what is not seen by vision.
config::ThrowerRig with_small_pictures(config::ThrowerRig rig);

/// The rig as the eyes need it.
config::ThrowerRig simulated_rig(const ThrowRequest& request);

/// Sees on the robot's rink what vision would see there (measured_quality()).
OracleSeer oracle_of(const SimulatedRobot& robot, const config::ThrowerRig& rig);

/// The devices boot and answer before anybody is asked to throw.
void boot(SimulatedRobot& robot, Duration period);

/// One control period of the rink: a release that is due within it is ordered at its moment.
void pass_period(hw::sim::Rink& rink, ThrowerLoop& loop, Duration period);

/// The same request gives the same outcome but for wall_time_s, which is left zero.
ThrowOutcome throw_stone(const ThrowRequest& request, const Progress& progress);

}  // namespace hogline
