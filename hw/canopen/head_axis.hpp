// Pan or tilt: a drive node in profile position (point) or cyclic synchronous velocity (track), in the head's radians.
// No IO.
#pragma once

#include <optional>
#include <vector>

#include "hw/canopen/axis_units.hpp"
#include "hw/canopen/driven_axis.hpp"
#include "hw/canopen/feedback_check.hpp"
#include "hw/canopen/head_config.hpp"
#include "hw/canopen/set_point_handshake.hpp"

namespace hogline::hw {

class HeadAxis final : public DrivenAxis {
 public:
  /// Precondition: config_error(config) is empty and `axis` is one of its axes.
  HeadAxis(const HeadAxisConfig& axis, const TwoAxisHeadConfig& config);

  DriveNode& node() override { return node_; }
  const DriveNode& node() const override { return node_; }
  void boot(Stamp now) override;
  void on_frame(const StampedCanFrame& received, Stamp now) override;
  void step(Stamp now) override;

  bool within_limits(double angle_rad) const;
  bool within_speed(double rate_radps) const;
  /// A new profile move. Precondition: within_limits().
  void point(double angle_rad, Stamp now);
  /// This rate for the coming step. Precondition: within_speed().
  void track(double rate_radps, Stamp now);

  /// The RPDOs for this step: none while the node has not been started.
  std::vector<CanFrame> command(Cia402Goal goal, Stamp now);

  double angle_rad() const;
  double rate_radps() const { return units_.radps(node_.velocity()); }
  /// The last point() was acknowledged, reached by the drive's word and by its position.
  bool on_target() const { return on_target_; }

 private:
  void supervise_move(Stamp now);
  double allowed_rate(double rate_radps) const;
  Duration longest_move(double way_rad) const;

  HeadAxisConfig config_;
  AxisUnits units_;
  Duration answer_time_;  ///< for an acknowledgement, and beyond a move's own time
  DriveNode node_;
  FeedbackCheck check_;

  SetPointHandshake handshake_;
  std::optional<double> target_rad_;  ///< of the last point(), until another use of the axis
  Stamp arrival_due_{};
  bool on_target_ = false;
  double rate_radps_ = 0.0;  ///< in cyclic velocity, as sent
};

}  // namespace hogline::hw
