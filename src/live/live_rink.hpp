// The simulated rink in real time behind this machine's own lines, for a thrower that is another program: its drives on
// the rig's CAN bus, gripper and arm at its Modbus port, the gyro at its serial device's path, and its cameras'
// pictures in shared memory.
#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <thread>
#include <vector>

#include "hw/shared_frames/frame_writer.hpp"
#include "hw/sim/rink.hpp"
#include "hw/sim/rink_cameras.hpp"
#include "src/config/thrower_rig.hpp"
#include "src/live/pty_line.hpp"
#include "src/live/truth_log.hpp"
#include "src/steel/robot_bus.hpp"

namespace hogline {

class LiveRink {
 public:
  /// Begins at `now`. Throws ConfigError where the rig's lines are not such as can be served here, std::runtime_error
  /// where one of them is taken. The log must outlive the rink.
  LiveRink(const config::ThrowerRig& rig, const hw::sim::Scenario& scenario, TruthLog& log, Stamp now);
  ~LiveRink();
  LiveRink(const LiveRink&) = delete;
  LiveRink& operator=(const LiveRink&) = delete;

  /// Lets the world go on to `now`, a millisecond at a time. What came over the bus acts in the millisecond of its own
  /// arrival: a program that was kept waiting makes up for it, and no drive takes that for a silent master.
  void pass(Stamp now);
  Stamp now() const { return rink_.now(); }
  const hw::sim::Truth& truth() const { return rink_.truth(); }

 private:
  struct View {
    View(hw::sim::RenderedCamera camera, const std::string& segment, const hw::FrameRingShape& shape,
         std::uint64_t session, const std::atomic<Stamp>& world);
    hw::sim::RenderedCamera camera;
    hw::FrameWriter writer;
    std::jthread thread;
  };
  void add_view(const config::ThrowerRig& rig, const char* name);
  static void render(View& view, const std::atomic<Stamp>& world, const std::stop_token& stop);
  void exchange();

  hw::sim::Scenario scenario_;
  hw::sim::Rink rink_;
  RobotBus bus_;
  PtyLine gyro_line_;
  TruthLog& log_;
  std::deque<hw::StampedCanFrame> arrived_;
  std::atomic<Stamp> world_;                  ///< the rink's time, for the threads that render
  std::vector<std::unique_ptr<View>> views_;  // last: their threads look at the rink
};

}  // namespace hogline
