// The simulated rink in real time behind this machine's own lines, for robots that are other programs: their drives on
// the rigs' CAN buses, gripper and arm at the thrower's Modbus port, the gyro at its serial device's path, and all
// cameras' pictures in shared memory.
#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "hw/shared_frames/frame_writer.hpp"
#include "hw/sim/team_rink.hpp"
#include "src/live/pty_line.hpp"
#include "src/live/sole_owner.hpp"
#include "src/live/truth_log.hpp"
#include "src/skip/simulated_skip.hpp"
#include "src/steel/robot_bus.hpp"
#include "src/throwing/simulated_robot.hpp"

namespace hogline {

class LiveRink {
 public:
  /// Begins at `now`. Throws ConfigError where the rig's lines are not such as can be served here, std::exception where
  /// one of them is taken. The log must outlive the rink.
  /// With the skip's rig its head and cameras are there too, and stones run on to the far house; the scenario then has
  /// a skip.
  LiveRink(const config::ThrowerRig& rig, const std::optional<config::SkipRig>& skip, const hw::sim::Scenario& scenario,
           TruthLog& log, Stamp now);
  ~LiveRink();
  LiveRink(const LiveRink&) = delete;
  LiveRink& operator=(const LiveRink&) = delete;

  /// Lets the world go on to `now`, a millisecond at a time. What came over the bus acts in the millisecond of its own
  /// arrival: a program that was kept waiting makes up for it, and no drive takes that for a silent master.
  void pass(Stamp now);
  Stamp now() const { return robot_.rink().now() + ahead_; }
  /// A person carries the robot back to the hack and lays the next stone before it, between jaws that are open. False,
  /// and nothing happens, while the robot or a stone moves.
  /// `team`: whose; without it the other team's than the last.
  bool put_back(std::optional<int> team = std::nullopt);

 private:
  /// A camera of the rink and where its pictures go.
  struct View {
    View(hw::sim::RenderedCamera& rendered, const std::string& segment, const hw::FrameRingShape& shape,
         const LiveRink& rink);
    hw::sim::RenderedCamera& camera;
    hw::FrameWriter writer;
    std::jthread thread;
  };
  void add_view(const config::Rig& rig, const char* name, hw::sim::RenderedCamera& camera);
  void render(View& view, const std::stop_token& stop) const;
  /// A robot's bus on this machine and its other end on the rink.
  struct BusEnd {
    BusEnd(const config::Rig& rig, hw::CanBus& on_the_rink, Stamp now) : bus(rig, now), rink(on_the_rink) {}
    void listen(Stamp now);
    void deliver(Stamp until);
    void answer();

    RobotBus bus;
    hw::CanBus& rink;
    std::deque<hw::StampedCanFrame> arrived;
  };
  void exchange();

  std::vector<SoleOwner> owned_;  ///< first: what another rink serves is not touched
  SimulatedRobot robot_;          ///< its devices; the adapters beside them are never stepped
  std::optional<SimulatedSkip> skip_;
  std::optional<hw::sim::TeamRink> sheet_;  ///< both robots' ends of it
  bool stone_runs_ = false;
  int team_ = 0;    ///< whose stone is next
  Duration ahead_;  ///< the steady clock's, of the rink's
  std::deque<BusEnd> buses_;
  PtyLine gyro_line_;
  TruthLog& log_;
  std::atomic<Stamp> world_;                  ///< the rink's time, for the threads that render
  std::vector<std::unique_ptr<View>> views_;  // last: their threads look at the rink
};

}  // namespace hogline
