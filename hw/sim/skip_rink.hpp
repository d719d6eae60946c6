// The skip's end of the simulated rink: stones that run and collide, and the head's two drives on a CAN bus. No
// controller inside.
#pragma once

#include <optional>
#include <vector>

#include "hw/clock.hpp"
#include "hw/sim/cia402_drive_device.hpp"
#include "hw/sim/scenario.hpp"
#include "hw/sim/skip_history.hpp"
#include "hw/sim/stone_field.hpp"
#include "hw/sim/virtual_can_bus.hpp"

namespace hogline::hw::sim {

/// A head axis' drive and how it is mounted.
struct HeadAxisRig {
  Cia402DriveConfig device;  ///< its axis' bandwidth and dead time come from the scenario
  double gear_ratio = 0.0;   ///< motor revolutions per revolution of the axis
  int direction = 0;         ///< +1 or -1
  double zero_counts = 0.0;  ///< the encoder where it means angle 0
  double min_rad = 0.0;      ///< what the mechanics reach
  double max_rad = 0.0;
};

/// The stone that comes. The thrower is not simulated: it lets go at this moment.
struct Delivery {
  Duration after{};  ///< the rink's start
  FieldStone stone;
};

struct SkipRinkConfig {
  Scenario scenario;  ///< with its skip
  HeadAxisRig pan;
  HeadAxisRig tilt;
  VirtualCanBusConfig bus;
  std::vector<FieldStone> standing;
  std::optional<Delivery> delivery;
};

/// The program reaches it only as it reaches steel: frames on a CAN bus and pictures. Everything moves in step(), in
/// substeps of a millisecond and in this order: bus, stones, drives, bus, history. The same configuration and the same
/// program give the same bytes. Precondition: config.scenario.skip has a value.
class SkipRink {
 public:
  SkipRink(const SkipRinkConfig& config, Stamp start);

  /// Advances by one control period. Precondition: span > 0.
  void step(Duration span);

  /// A stone that a thrower let go at `released`, where it is now.
  void deliver(const FieldStone& stone, Stamp released);
  /// Nothing is thrown any more: what was thrown before is one of those that stand. Another throw's friction by `seed`.
  void begin_throw(std::uint64_t seed);

  const Clock& clock() const { return clock_; }
  Stamp now() const { return clock_.now(); }
  Stamp start() const { return start_; }
  const StoneField& field() const { return field_; }
  StoneField& field() { return field_; }  ///< for a person's hand, but for:
  /// Every stone is taken off the ice. Their numbers begin anew.
  void take_all_off();
  const SkipHistory& history() const { return history_; }
  HeadTruth head() const { return {pan_.angle_rad(), tilt_.angle_rad(), pan_.rate_radps(), tilt_.rate_radps()}; }
  /// The least way of either axis to the end of its mechanics so far.
  double least_room_rad() const { return least_room_rad_; }
  std::optional<Stamp> released() const { return released_; }
  /// The number of the thrown stone, once it is on the ice.
  std::optional<std::size_t> thrown() const { return thrown_; }

  CanBus& can() { return program_can_; }

  /// The devices, for faults.
  VirtualCanBus& bus() { return bus_; }
  Cia402DriveDevice& pan_drive() { return pan_.device; }
  Cia402DriveDevice& tilt_drive() { return tilt_.device; }

 private:
  struct Axis {
    Axis(const HeadAxisRig& rig, const DriveScenario& drive, double zero_error_rad, CanBus& bus);
    void step(Stamp now, double dt_s);
    double angle_rad() const;
    double rate_radps() const { return motor_radps / (rig.direction * rig.gear_ratio); }

    HeadAxisRig rig;
    Cia402DriveDevice device;
    double zero_error_rad;
    double motor_radps = 0.0;
  };
  void substep(Duration span);
  void remember();

  Stamp start_;
  SteppedClock clock_;
  VirtualCanBus bus_;
  CanBus& program_can_;
  Axis pan_;
  Axis tilt_;
  StoneField field_;
  std::optional<Delivery> delivery_;
  std::optional<Stamp> released_;
  std::optional<std::size_t> thrown_;
  SkipHistory history_;
  double least_room_rad_ = 10.0;
};

}  // namespace hogline::hw::sim
