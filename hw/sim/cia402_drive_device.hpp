// A simulated CiA 402 drive on the bus, written from CiA 301 and 402: profile velocity, cyclic synchronous velocity
// and, where the drive has it, profile position.
#pragma once

#include <cstdint>
#include <optional>

#include "hw/sim/canopen_device.hpp"
#include "hw/sim/drive_axis.hpp"
#include "hw/sim/position_profile.hpp"

namespace hogline::hw::sim {

struct Cia402DriveConfig {
  DeviceIdentity identity;  ///< device_type 0x00020192: servo drive
  DriveAxisConfig axis;
  double position_counts_per_rev = 0.0;      ///< of 6064, per motor revolution
  double velocity_units_per_rps = 0.0;       ///< of 606C and 60FF, per motor revolution per second
  double acceleration_units_per_rps2 = 0.0;  ///< of 6083, 6084, 6085
  double switch_on_time_s = 0.0;             ///< how long transition 3 takes
  bool profile_position = false;             ///< has mode 1
};

/// What a test can break in the drive beyond its communication (`communication().faults`).
struct DriveFaults {
  bool statusword_stuck = false;      ///< 6041 keeps its value
  bool quick_stop_ignored = false;    ///< bit 2 of the controlword has no effect
  bool mode_never_confirmed = false;  ///< 6061 stays 0
  bool speed_stuck = false;           ///< the axis keeps the speed it is driven with
  bool set_point_ignored = false;     ///< statusword bit 12 never answers controlword bit 4
  bool acknowledge_stuck = false;     ///< statusword bit 12 stays up
  bool reached_at_once = false;       ///< statusword bit 10 is up wherever the axis is
  double position_scale = 1.0;        ///< of 6064: a wrong encoder resolution or, negative, sense
};

class Cia402DriveDevice final : private CanopenDevice::Application {
 public:
  Cia402DriveDevice(CanBus& bus, const Cia402DriveConfig& config);

  /// The axis has turned with `axis_speed_radps` (of the motor) for the last dt_s; talks on the bus; says what the
  /// drive now does to the axis. Precondition: dt_s > 0.
  AxisCommand step(Stamp now, double dt_s, double axis_speed_radps);

  /// A fault of the drive: EMCY with this code, fault reaction, fault.
  void raise_fault(std::uint16_t error_code);
  /// The node dies: silent for ever, and its axis is left like this.
  void kill(AxisPower axis_left);
  /// The supply fails for a moment: boots anew, without power on the motor.
  void power_cycle();

  CanopenDevice& communication() { return communication_; }
  const CanopenDevice& communication() const { return communication_; }
  DriveAxis& axis() { return axis_; }
  const DriveAxis& axis() const { return axis_; }
  bool operation_enabled() const { return state_ == State::operation_enabled; }
  bool quick_stop_active() const { return state_ == State::quick_stop_active; }
  bool in_fault() const { return state_ == State::fault || state_ == State::fault_reaction_active; }

  DriveFaults faults;

 private:
  enum class State {
    not_ready,
    switch_on_disabled,
    ready_to_switch_on,
    switched_on,
    operation_enabled,
    quick_stop_active,
    fault_reaction_active,
    fault,
  };

  void on_reset() override;
  void on_communication_lost() override;

  void add_drive_objects();
  void obey_controlword(double axis_speed_radps);
  void run_state(double dt_s, double axis_speed_radps);
  void add_profile_position_objects();
  void run_enabled(double dt_s);
  void obey_set_point_bits(std::uint16_t word);
  void take_set_point(std::uint16_t word);
  void run_profile_position(double dt_s);
  double position_counts() const;
  void run_ramp(double dt_s, double deceleration_rps2);
  double quick_stop_deceleration() const;
  double fault_deceleration() const;
  void start_quick_stop();
  void publish();
  std::uint16_t mode_bits() const;
  std::uint16_t statusword() const;
  AxisCommand act(double dt_s, double axis_speed_radps);

  Cia402DriveConfig config_;
  CanopenDevice communication_;
  DriveAxis axis_;
  State state_ = State::not_ready;
  std::uint16_t last_controlword_ = 0;
  bool controlword_is_old_ = false;  ///< from before the communication was lost
  double demand_rps_ = 0.0;          ///< the ramp generator's output, motor revolutions per second
  double switching_on_s_ = 0.0;
  PositionProfile profile_;
  AxisPower dead_axis_ = AxisPower::unpowered;
};

}  // namespace hogline::hw::sim
