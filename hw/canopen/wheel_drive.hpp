// One CiA 402 wheel drive on the bus: boot, configuration, supervision. Frames and time in, frames out, no IO.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hw/canopen/cia402_stepper.hpp"
#include "hw/canopen/drive_config.hpp"
#include "hw/canopen/emergency.hpp"
#include "hw/canopen/feedback_check.hpp"
#include "hw/canopen/nmt.hpp"
#include "hw/canopen/wheel_boot.hpp"
#include "hw/canopen/wheel_units.hpp"
#include "hw/device_status.hpp"

namespace hogline::hw {

/// Each step: on_frame() for what arrived, step(now), send what take_frame() gives, and command() once if wanted.
class WheelDrive {
 public:
  enum class Stage {
    idle,
    booting,         ///< WheelBoot
    starting,        ///< NMT start: waits for heartbeat and PDOs in operational
    clearing_fault,  ///< fault reset by its edge, until switch on disabled
    operational,     ///< supervised
    failed,          ///< error() says why; takes stopping goals only
  };

  /// Precondition: config_error(config) is empty and `wheel` is one of its wheels.
  WheelDrive(const WheelConfig& wheel, const TwoWheelDriveConfig& config);

  /// Begins from the identity check, and forgets any error.
  void boot(Stamp now);
  /// Gives up a boot in progress, without an error of its own: something else is wrong.
  void abandon_boot();
  /// Any frame of the bus; others' are ignored.
  void on_frame(const StampedCanFrame& received, Stamp now);
  /// Boot progress, deadlines and plausibility.
  void step(Stamp now);
  std::optional<CanFrame> take_frame();

  /// The RPDO for this step, or nothing while the node has not been started. The target counts only while the goal is
  /// `enabled` and the drive is there; otherwise 0 is sent.
  std::optional<CanFrame> command(Cia402Goal goal, double target_radps, Stamp now);

  Stage stage() const { return stage_; }
  WheelBoot::Stage boot_stage() const { return boot_.stage(); }
  bool operational() const { return stage_ == Stage::operational; }
  Cia402State state() const { return state_; }
  double speed_radps() const { return speed_radps_; }
  /// Of the newest feedback; nothing before the first since boot().
  std::optional<Stamp> feedback_stamp() const;
  /// Fresh feedback says that the wheel stands and is not driven; true also if it was never started.
  bool at_rest(Stamp now) const;
  /// Fresh feedback says that the drive has no power on the motor; true also if it was never started.
  bool without_power(Stamp now) const;
  const std::optional<DeviceError>& error() const { return error_; }
  /// "left wheel (node 1)".
  const std::string& label() const { return label_; }
  /// Object 1008, empty if the device has none.
  const std::string& device_name() const { return boot_.device_name(); }

 private:
  void enter(Stage stage, Stamp now);
  void halt();
  void fail(DeviceErrorKind kind, std::string what, Stamp now);
  void advance_boot(Stamp now);
  void await_start(Stamp now);
  void await_cleared_fault(Stamp now);
  void check_stage_deadline(Stamp now);

  void on_heartbeat(NmtState state, Stamp stamp, Stamp now);
  void on_emergency(const Emergency& emergency, Stamp now);
  void on_status(const StampedCanFrame& received, Stamp now);
  void on_position(const StampedCanFrame& received, Stamp now);

  void supervise_communication(Stamp now);
  void supervise_drive(Stamp now);
  void supervise_transition(Stamp now);
  bool feedback_fresh(Stamp now) const;

  WheelConfig wheel_;
  DriveTiming timing_;
  double standstill_radps_;
  std::string label_;
  WheelUnits units_;

  Stage stage_ = Stage::idle;
  Stamp stage_since_{};
  WheelBoot boot_;
  bool started_ = false;  ///< NMT start was sent in this boot
  std::optional<CanFrame> start_frame_;

  std::optional<Stamp> heartbeat_stamp_;
  NmtState nmt_state_ = NmtState::unknown;
  std::optional<Emergency> last_emergency_;

  Cia402Stepper stepper_;
  Cia402State state_ = Cia402State::unknown;
  double target_radps_ = 0.0;
  bool was_enabled_ = false;

  std::optional<Stamp> status_stamp_;
  std::optional<Stamp> position_stamp_;
  std::int32_t position_ = 0;
  std::int8_t mode_ = 0;
  std::uint16_t error_code_ = 0;
  double speed_radps_ = 0.0;
  FeedbackCheck check_;

  std::optional<DeviceError> error_;
};

}  // namespace hogline::hw
