// One wheel: a drive node in cyclic synchronous velocity, in the wheel's radians. No IO.
#pragma once

#include <optional>
#include <string>

#include "hw/canopen/axis_units.hpp"
#include "hw/canopen/drive_config.hpp"
#include "hw/canopen/driven_axis.hpp"
#include "hw/canopen/feedback_check.hpp"

namespace hogline::hw {

class WheelDrive final : public DrivenAxis {
 public:
  /// Precondition: config_error(config) is empty and `wheel` is one of its wheels.
  WheelDrive(const WheelConfig& wheel, const TwoWheelDriveConfig& config);

  DriveNode& node() override { return node_; }
  const DriveNode& node() const override { return node_; }
  void boot(Stamp now) override;
  void on_frame(const StampedCanFrame& received, Stamp now) override;
  void step(Stamp now) override;

  /// The RPDO for this step, or nothing while the node has not been started. The target counts only while the goal is
  /// `enabled` and the drive is there; otherwise 0 is sent.
  std::optional<CanFrame> command(Cia402Goal goal, double target_radps, Stamp now);

  double speed_radps() const { return units_.radps(node_.velocity()); }
  const std::string& device_name() const { return node_.device_name(); }
  NodeBoot::Stage boot_stage() const { return node_.boot_stage(); }

 private:
  AxisUnits units_;
  DriveNode node_;
  FeedbackCheck check_;
  double target_radps_ = 0.0;
};

}  // namespace hogline::hw
