// One row of the fault table: what breaks, how, when, and what the robot must do about it.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "src/throwing/simulated_throw.hpp"

namespace hogline::faults {

enum class Group { can, modbus, gyro, camera, host };
const char* to_string(Group group);

/// When the fault strikes.
enum class Strike {
  power_on,     ///< before the devices boot
  rehearsing,   ///< 20 ms after the first order to open the jaws on the standing stone
  set_down,     ///< ... when they have let it go
  measuring,    ///< 0.3 s after the robot began to measure its place
  aligning,     ///< 0.3 s after it began to turn
  speeding_up,  ///< 1 s into the run
  full_speed,   ///< in the run, at 2.5 m/s less 2 %
  braking,      ///< 0.1 s after a first fault at full speed stopped the robot
  too_late,     ///< in the run, when the robot can not stop before the hog line any more
  released,     ///< in the period after the one that ordered the release
};
const char* to_string(Strike strike);

enum class Expect {
  stops,                ///< aborts, brakes, keeps the stone
  goes_on,              ///< survivable by design: the stone is released in its window, within tolerance
  does_not_start,       ///< found before anything is powered
  stops_without_stone,  ///< the jaws lose it: it can not be kept
  brakes_after,         ///< the stone was let go in its window; the robot brakes
};

/// What a fault can get hold of. Wires and devices; nothing of the program but whether it runs.
struct Site {
  SimulatedRobot& robot;
  hw::CanBus& stranger;                      ///< a node that does not belong on the bus
  std::function<void()> each_ms;             ///< called every millisecond while set
  Duration loop_late{};                      ///< the control loop's next period comes this much late
  bool loop_dead = false;                    ///< the program does not run
  std::optional<hw::WheelSpeeds> set_point;  ///< given to the drive behind the controller's back, once

  hw::sim::Rink& rink() const { return robot.rink(); }
  hw::sim::Cia402DriveDevice& left() const { return robot.rink().left_drive(); }
  hw::sim::Cia402DriveDevice& right() const { return robot.rink().right_drive(); }
};

using Action = std::function<void(Site&)>;

struct Case {
  std::string name;
  Group group = Group::can;
  std::string injected;  ///< how
  Strike strike = Strike::full_speed;
  Expect expect = Expect::stops;
  Duration deadline{};  ///< from the injection to the abort, or to the device's error where nothing moves yet
  std::string says;     ///< what stands in the reason: the device, and what is wrong with it
  Action inject;
  Action heal;                                   ///< takes the cause away; may be empty
  Duration lasts{};                              ///< healed after so long; zero: after the robot stands, or never
  std::function<void(ThrowRequest&)> prepare{};  ///< before the robot is built
  double stop_limit_m = 0.0;                     ///< the longest way to standstill; zero: what a quick stop needs
  std::string shortcoming{};                     ///< why this row does not end as it should; empty: it does
};

std::vector<Case> can_node_faults();
std::vector<Case> can_bus_faults();
std::vector<Case> modbus_faults();
std::vector<Case> gyro_faults();
std::vector<Case> camera_faults();
std::vector<Case> host_faults();

/// All of them, in the order of the page.
const std::vector<Case>& fault_table();

/// Whether group, name or way of injection contains these words, large or small letters.
bool mentions(const Case& fault, std::string_view words);

}  // namespace hogline::faults
