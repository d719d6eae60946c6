// The robot's base on CANopen: two CiA 402 wheel drives in cyclic synchronous velocity on one bus.
#pragma once

#include <array>
#include <optional>

#include "hw/can_bus.hpp"
#include "hw/canopen/drive_config.hpp"
#include "hw/canopen/wheel_drive.hpp"
#include "hw/drive.hpp"

namespace hogline::hw {

/// Boots by itself from the first step(). Any fault of one wheel, of the bus or of the caller latches an error and
/// quick-stops both. A set-point is sent in one step only, never repeated and never kept over an interruption; without
/// a new one within command_age_limit, or if step() itself comes later than that, it is a fault. rearm() has no effect
/// while the wheels still brake; it boots both nodes again from the identity check.
class TwoWheelDrive final : public Drive {
 public:
  /// Throws std::invalid_argument with config_error()'s text. The bus must outlive the drive.
  TwoWheelDrive(CanBus& bus, const TwoWheelDriveConfig& config);

  void step(Stamp now) override;
  DriveState state() const override;
  void enable() override;
  void command(const WheelSpeeds& speeds, Stamp now) override;
  void quick_stop() override;
  void rearm() override;

  const WheelDrive& left() const { return wheels_[0]; }
  const WheelDrive& right() const { return wheels_[1]; }

 private:
  enum class Activity { booting, ready, enabling, enabled, braking, powering_off, stopped };
  struct SetPoint {
    WheelSpeeds speeds;
    Stamp stamp;
  };

  void watch_own_rhythm(Stamp now);
  void receive(Stamp now);
  void watch_for_other_masters(const CanFrame& frame, Stamp now);
  void watch_bus(Stamp now);
  void step_wheels(Stamp now);
  void advance(Stamp now);
  void advance_to_stop(bool faulted, Stamp now);
  void expire_command(Stamp now);
  void send(Stamp now);
  void send_commands(Stamp now);
  void discard_outgoing();

  void enter(Activity activity, Stamp now);
  void fail(DeviceErrorKind kind, std::string device, std::string what, Stamp now);
  DrivePhase phase() const;
  Cia402Goal goal() const;
  template <typename Predicate>
  bool both(Predicate holds) const;
  Duration stop_deadline() const;

  CanBus& bus_;
  TwoWheelDriveConfig config_;
  std::array<WheelDrive, 2> wheels_;

  Activity activity_ = Activity::booting;
  Stamp activity_since_{};
  bool boot_requested_ = true;
  bool enable_requested_ = false;
  bool stop_requested_ = false;
  std::optional<DeviceError> error_;

  std::optional<SetPoint> pending_;  ///< for the next step only
  Stamp last_set_point_{};
  std::optional<Stamp> last_step_;
  std::optional<Stamp> next_heartbeat_;
  std::optional<Stamp> blocked_since_;
};

}  // namespace hogline::hw
