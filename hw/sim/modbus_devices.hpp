// The simulated jaws, spin belt and folding arm behind one Modbus station.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>

#include "hw/sim/axis_device.hpp"
#include "hw/sim/jaws_device.hpp"
#include "hw/sim/modbus_server.hpp"

namespace hogline::hw::sim {

/// The devices move only in step(): a client that makes its exchanges between two steps meets the same devices in every
/// run. Units 9 (jaws), 10 (belt), 11 (arm).
class ModbusDevices {
 public:
  ModbusDevices(const GripperScenario& gripper, const SpinBeltScenario& belt, const ArmScenario& arm,
                std::uint64_t seed, Stamp start);

  /// Serves TCP on the loopback interface, in a thread of its own, from the first call on. The server's port.
  int port() { return server().port(); }
  /// The same at a port of the caller's choice. Precondition: nothing has been served yet. Throws std::system_error.
  void serve_tcp(int port);
  /// The same devices over RTU on a pseudo terminal: the path of the end that a client opens. After a restart() the
  /// path is another one.
  std::string serve_rtu() { return server().serve_rtu(); }
  std::string rtu_path() const { return server_ ? server_->rtu_path() : std::string(); }
  /// For a ModbusPlug: which life of the line this is; 0 while it is stopped.
  unsigned serving() const { return stopped_ ? 0 : life_; }
  ModbusReply take(ModbusStationLine& line, std::span<const std::uint8_t> bytes);
  void step(Stamp now);
  /// What the world does to the devices: a stone stands where closing fingers meet it.
  void stone_between(bool between);

  /// What the devices do to the world.
  struct Effects {
    bool stone_in_jaws = false;
    std::optional<Stamp> stone_free_at;  ///< may lie in the future: the jaws are opening
    double belt_radps = 0.0;
    double arm_unfolded = 0.0;  ///< 0 folded .. 1 unfolded
  };
  Effects effects() const;

  /// Fault injection. stop() is a server that dies, stall() one that accepts but never answers.
  void stop();
  void restart();
  void stall() { set_faults({.stalled = true}); }
  void set_faults(const ModbusServerFaults& faults);
  /// Calls change(jaws, belt, arm) while no request is being answered.
  template <typename Change>
  void inject(Change&& change) {
    const std::lock_guard lock(mutex_);
    change(jaws_, belt_, arm_);
  }

 private:
  ModbusServer& server();

  mutable std::mutex mutex_;
  JawsDevice jaws_;
  BeltDevice belt_;
  ArmDevice arm_;
  ModbusStation station_;
  unsigned life_ = 1;
  bool stopped_ = false;
  std::unique_ptr<ModbusServer> server_;  // last: its thread uses the devices
};

}  // namespace hogline::hw::sim
