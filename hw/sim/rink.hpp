// The simulated rink: every device and the world they move, stepped by one clock. No controller inside.
#pragma once

#include <string>

#include "hw/clock.hpp"
#include "hw/sim/cia402_drive_device.hpp"
#include "hw/sim/gyro_device.hpp"
#include "hw/sim/modbus_devices.hpp"
#include "hw/sim/scenario.hpp"
#include "hw/sim/virtual_can_bus.hpp"
#include "hw/sim/world.hpp"
#include "hw/sim/world_history.hpp"

namespace hogline::hw::sim {

/// A wheel's drive and how it is mounted.
struct WheelRig {
  Cia402DriveConfig device;  ///< its axis' bandwidth and dead time come from the scenario
  double gear_ratio = 0.0;   ///< motor revolutions per wheel revolution
  int direction = 0;         ///< +1 or -1: the motor's positive sense turns the wheel forward or backward
};

struct RinkConfig {
  Scenario scenario;
  WheelRig left;
  WheelRig right;
  VirtualCanBusConfig bus;
};

/// The program reaches it only as it reaches steel: frames on a CAN bus, registers on a Modbus line, bytes of a gyro,
/// pictures. Everything moves in step(), in substeps of a millisecond and in this order: bus, world, drives, bus,
/// Modbus devices, gyro, history. What the program sends between two steps arrives at the beginning of the next one.
/// The same configuration and the same program give the same bytes.
class Rink {
 public:
  Rink(const RinkConfig& config, Stamp start);

  /// Advances by one control period. Precondition: span > 0.
  void step(Duration span);

  /// See World: for a rink that is the thrower's end of a sheet with more on it.
  void stones_are(const SheetStones& sheet) { world_.stones_are(sheet); }
  void put_back(const PlanarPose& body, int team, double handle_rad);

  /// Lets released stones come to rest while everything else, and the clock, stands still. For throws whose robot is
  /// done.
  void settle() { world_.settle(); }

  const Clock& clock() const { return clock_; }
  Stamp now() const { return clock_.now(); }
  Stamp start() const { return start_; }
  const Truth& truth() const { return world_.truth(); }
  const WorldHistory& history() const { return history_; }

  /// The program's ends of the lines.
  CanBus& can() { return program_can_; }
  int modbus_port() { return modbus_.port(); }
  std::string read_gyro() { return gyro_.read(); }

  /// The devices, for faults.
  VirtualCanBus& bus() { return bus_; }
  Cia402DriveDevice& left_drive() { return left_.device; }
  Cia402DriveDevice& right_drive() { return right_.device; }
  ModbusDevices& modbus() { return modbus_; }
  GyroDevice& gyro() { return gyro_; }

 private:
  struct Wheel {
    Wheel(const WheelRig& rig, const DriveScenario& drive, CanBus& bus);
    void step(Stamp now, double dt_s, double wheel_radps);
    std::optional<double> axis_radps() const;

    Cia402DriveDevice device;
    double motor_per_wheel;  ///< gear ratio with the sign of the mounting
    AxisCommand command;
  };
  void substep(Duration span);

  Stamp start_;
  SteppedClock clock_;
  VirtualCanBus bus_;
  CanBus& program_can_;
  Wheel left_;
  Wheel right_;
  ModbusDevices modbus_;
  GyroDevice gyro_;
  World world_;
  WorldHistory history_;
};

}  // namespace hogline::hw::sim
