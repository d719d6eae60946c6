// One CiA 402 drive node on the bus: boot, configuration, supervision. Frames and time in, frames out, no IO. What its
// axis is (a wheel, pan, tilt) is its owner's business.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hw/canopen/cia402_stepper.hpp"
#include "hw/canopen/drive_config.hpp"
#include "hw/canopen/emergency.hpp"
#include "hw/canopen/nmt.hpp"
#include "hw/canopen/node_boot.hpp"
#include "hw/device_status.hpp"

namespace hogline::hw {

/// Each step: on_frame() for what arrived, step(now), send what take_frame() gives, and control() once if wanted.
class DriveNode {
 public:
  enum class Stage {
    idle,
    booting,         ///< NodeBoot
    starting,        ///< NMT start: waits for heartbeat and PDOs in operational
    clearing_fault,  ///< fault reset by its edge, until switch on disabled
    operational,     ///< supervised
    failed,          ///< error() says why; takes stopping goals only, and NMT stop if nobody sees it obey
  };
  /// Two readings of the encoder.
  struct Travel {
    std::int32_t from = 0;
    std::int32_t to = 0;
    Duration dt{};
  };

  /// `standstill` is in 606C's units. The node is booted into `mode`.
  DriveNode(const NodeIdentity& identity, const DriveTiming& timing, std::vector<SdoWrite> setup, std::int8_t mode,
            double standstill);

  /// Begins from the identity check, and forgets any error.
  void boot(Stamp now);
  /// Gives up a boot in progress, without an error of its own: something else is wrong.
  void abandon_boot();
  /// Any frame of the bus; others' are ignored. What a newer position says about the way since the one before.
  std::optional<Travel> on_frame(const StampedCanFrame& received, Stamp now);
  /// Boot progress, deadlines, states.
  void step(Stamp now);
  std::optional<CanFrame> take_frame();

  /// The controlword for this step, or nothing while the node has not been started. A node that is not operational, or
  /// has failed, takes only goals that stop it.
  std::optional<Cia402Command> control(Cia402Goal goal, Stamp now);
  /// The mode that 6061 must show from now on; a change has the time of a state transition.
  void set_mode(std::int8_t mode, Stamp now);
  /// An error that the owner has found. The first one stays.
  void fail(DeviceErrorKind kind, std::string what, Stamp now);

  Stage stage() const { return stage_; }
  NodeBoot::Stage boot_stage() const { return boot_.stage(); }
  bool operational() const { return stage_ == Stage::operational; }
  /// Operation enabled was reached and is still wanted: set-points count.
  bool following() const { return following_; }
  Cia402State state() const { return state_; }
  std::uint16_t statusword() const { return statusword_; }
  bool in_mode() const { return mode_ == wanted_mode_; }
  std::int8_t wanted_mode() const { return wanted_mode_; }
  std::int32_t velocity() const { return velocity_; }  ///< 606C
  std::int32_t position() const { return position_; }  ///< 6064
  /// Of the older of the two TPDOs; nothing before both since boot().
  std::optional<Stamp> feedback_stamp() const;
  /// Fresh feedback says that the axis stands and is not driven; true also if it was never started.
  bool at_rest(Stamp now) const;
  /// Fresh feedback says that the drive has no power on the motor; true also if it was never started.
  bool without_power(Stamp now) const;
  const std::optional<DeviceError>& error() const { return error_; }
  std::uint8_t id() const { return id_; }
  /// "left wheel (node 1)".
  const std::string& label() const { return label_; }
  /// Object 1008, empty if the device has none.
  const std::string& device_name() const { return boot_.device_name(); }

 private:
  void enter(Stage stage, Stamp now);
  void halt();
  void advance_boot(Stamp now);
  void await_start(Stamp now);
  void await_cleared_fault(Stamp now);
  void check_stage_deadline(Stamp now);
  void cut_off_if_unseen(Stamp now);

  void on_heartbeat(NmtState state, Stamp stamp, Stamp now);
  void on_emergency(const Emergency& emergency, Stamp now);
  void on_status(const StampedCanFrame& received, Stamp now);
  void count_feedback(Stamp stamp);
  std::optional<Travel> on_position(const StampedCanFrame& received, Stamp now);

  void supervise_communication(Stamp now);
  void supervise_drive(Stamp now);
  void supervise_transition(Stamp now);
  bool feedback_fresh(Stamp now) const;

  std::uint8_t id_;
  DriveTiming timing_;
  double standstill_;
  std::string label_;

  Stage stage_ = Stage::idle;
  Stamp stage_since_{};
  NodeBoot boot_;
  bool started_ = false;               ///< NMT start was sent in this boot
  std::optional<CanFrame> nmt_frame_;  ///< start, or the last resort
  std::optional<Stamp> cut_off_;       ///< when the last resort was last sent

  std::optional<Stamp> heartbeat_stamp_;
  NmtState nmt_state_ = NmtState::unknown;
  std::optional<Emergency> last_emergency_;

  Cia402Stepper stepper_;
  Cia402State state_ = Cia402State::unknown;
  bool following_ = false;
  std::int8_t boot_mode_;
  std::int8_t wanted_mode_;
  Stamp mode_since_{};
  bool mode_confirmed_ = true;

  std::optional<Stamp> status_stamp_;
  std::optional<Stamp> position_stamp_;
  std::uint16_t statusword_ = 0;
  std::int32_t velocity_ = 0;
  std::int32_t position_ = 0;
  std::int8_t mode_ = 0;
  std::uint16_t error_code_ = 0;
  Stamp counted_until_{};  ///< of the newest TPDO1, or when the node was started
  double surplus_ = 0.0;   ///< TPDO1s beyond one a period, or missing from it

  std::optional<DeviceError> error_;
};

}  // namespace hogline::hw
