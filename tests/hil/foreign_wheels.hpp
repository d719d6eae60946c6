// The wheels' adapter over vcan0, with the foreign nodes 1 and 2 at the other end.
#pragma once

#include "tests/hil/drive_config.hpp"
#include "tests/hil/hil.hpp"

namespace hogline::hil {

class ForeignWheels {
 public:
  explicit ForeignWheels(const hw::TwoWheelDriveConfig& config = patient_drive_config());

  /// Boots, enables and runs until both wheels turn as commanded. The failure names the step and the drive's error.
  testing::AssertionResult run_at(const hw::WheelSpeeds& speeds);
  /// Control periods with these set-points until the drive is in this phase; false if it faults before, or never comes.
  bool drive_until(hw::DrivePhase phase, const hw::WheelSpeeds& speeds = {});
  /// Control periods with these set-points until `done` holds, whatever becomes of the drive.
  bool command_until(const hw::WheelSpeeds& speeds, const std::function<bool()>& done);

  bool left_stands() const;
  /// The latched error in words.
  std::string why() const;

  hw::SocketCanBus bus;
  hw::TwoWheelDrive drive;

 private:
  bool drive_until(const hw::WheelSpeeds& speeds, const std::function<bool()>& done);
};

}  // namespace hogline::hil
