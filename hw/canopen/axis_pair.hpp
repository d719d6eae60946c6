// Two drive nodes that live and stop together: booting, enabling, stopping, and what the bus does to them.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "hw/can_bus.hpp"
#include "hw/canopen/driven_axis.hpp"
#include "hw/drive_phase.hpp"

namespace hogline::hw {

struct AxisPairConfig {
  std::string name;  ///< "drive", in the errors that concern both
  std::uint8_t master_node = 0;
  DriveTiming timing;
  BusDuties duties;
  Duration stop_deadline{};  ///< from the quick stop to standstill
};

/// Boots by itself from the first step. Any fault of one axis, of the bus or of the owner latches an error and
/// quick-stops both. Each step of the owner: listen(), advance(), then send() with the RPDOs for goal().
class AxisPair {
 public:
  /// The axes and the bus must outlive the pair.
  AxisPair(CanBus& bus, AxisPairConfig config, std::array<DrivenAxis*, 2> axes);

  void listen(Stamp now);
  /// One step of the state machine.
  void advance(Stamp now);
  /// Heartbeat, boot frames, these commands, SYNC. While the bus is down all of it is dropped.
  void send(std::span<const CanFrame> commands, Stamp now);

  /// No effect in any phase but ready and stopped.
  void enable();
  void quick_stop();
  /// No effect while the axes still brake; boots both nodes again from the identity check.
  void rearm();
  /// The first error stays.
  void fail(DeviceErrorKind kind, std::string device, std::string what, Stamp now);

  DrivePhase phase() const;
  /// Enabled, without an error, and not asked to stop.
  bool takes_commands() const { return phase() == DrivePhase::enabled && !stop_requested_; }
  /// When it became enabled. Precondition: phase() is enabled.
  Stamp enabled_since() const { return activity_since_; }
  Cia402Goal goal() const;
  const std::optional<DeviceError>& error() const { return error_; }
  /// Of the older of the two axes' feedback; zero before the first.
  Stamp feedback_stamp() const;

 private:
  enum class Activity { booting, ready, enabling, enabled, braking, powering_off, stopped };

  void watch_own_rhythm(Stamp now);
  void receive(Stamp now);
  void watch_for_other_masters(const CanFrame& frame, Stamp now);
  void watch_bus(Stamp now);
  void step_axes(Stamp now);
  void advance_to_stop(bool faulted, Stamp now);
  void send_commands(std::span<const CanFrame> commands, Stamp now);
  void discard_outgoing();
  void enter(Activity activity, Stamp now);
  template <typename Predicate>
  bool both(Predicate holds) const;

  CanBus& bus_;
  AxisPairConfig config_;
  std::array<DrivenAxis*, 2> axes_;

  Activity activity_ = Activity::booting;
  Stamp activity_since_{};
  bool boot_requested_ = true;
  bool enable_requested_ = false;
  bool stop_requested_ = false;
  std::optional<DeviceError> error_;
  std::optional<Stamp> last_step_;
  std::optional<Stamp> next_heartbeat_;
  std::optional<Stamp> blocked_since_;
};

}  // namespace hogline::hw
