// The robot's base on CANopen: two CiA 402 wheel drives in cyclic synchronous velocity on one bus.
#pragma once

#include <array>
#include <optional>

#include "hw/can_bus.hpp"
#include "hw/canopen/axis_pair.hpp"
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
  TwoWheelDrive(const TwoWheelDrive&) = delete;
  TwoWheelDrive& operator=(const TwoWheelDrive&) = delete;

  void step(Stamp now) override;
  DriveState state() const override;
  void enable() override { pair_.enable(); }
  void command(const WheelSpeeds& speeds, Stamp now) override;
  void quick_stop() override;
  void rearm() override { pair_.rearm(); }

  const WheelDrive& left() const { return wheels_[0]; }
  const WheelDrive& right() const { return wheels_[1]; }

 private:
  struct SetPoint {
    WheelSpeeds speeds;
    Stamp stamp;
  };

  void expire_command(Stamp now);
  void send(Stamp now);

  TwoWheelDriveConfig config_;
  std::array<WheelDrive, 2> wheels_;
  AxisPair pair_;

  std::optional<SetPoint> pending_;  ///< for the next step only
  Stamp last_set_point_{};
};

}  // namespace hogline::hw
