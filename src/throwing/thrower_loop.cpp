#include "src/throwing/thrower_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "vision/geometry/sheet.hpp"

namespace hogline {
namespace {

// Devices that have not answered yet have the epoch as their stamp.
bool heard(Stamp stamp) { return stamp != Stamp{}; }

std::array<std::optional<hw::DeviceError>, 6> errors_of(const ThrowerDevices& devices) {
  return {devices.drive.state().error, devices.gripper.state().error, devices.arm.state().error,
          devices.gyro.state().error,  devices.near_camera.error(),   devices.low_camera.error()};
}

std::optional<std::string> first_error(const ThrowerDevices& devices) {
  for (const auto& error : errors_of(devices)) {
    if (error) return fmt::format("{}: {}: {}", error->device, to_string(error->kind), error->what);
  }
  return std::nullopt;
}

// By the wheels alone: the gyro's bias is what it shows then.
bool stands(const hw::DriveState& drive) {
  constexpr double standing_radps = 0.002;
  return heard(drive.stamp) && !drive.error && std::abs(drive.measured.left_radps) < standing_radps &&
         std::abs(drive.measured.right_radps) < standing_radps;
}

std::optional<servo::WheelObservation> observe_wheels(const hw::DriveState& drive) {
  if (!heard(drive.stamp)) return std::nullopt;
  return servo::WheelObservation{
      .stamp = drive.stamp,
      .left_radps = drive.measured.left_radps,
      .right_radps = drive.measured.right_radps,
      .ready = drive.phase == hw::DrivePhase::ready || drive.phase == hw::DrivePhase::stopped,
      .enabled = drive.phase == hw::DrivePhase::enabled,
  };
}

std::optional<servo::GripperObservation> observe_gripper(const hw::GripperState& gripper) {
  if (!heard(gripper.stamp)) return std::nullopt;
  return servo::GripperObservation{
      .stamp = gripper.stamp,
      .holding = gripper.jaws == hw::JawState::holding,
      .open = gripper.jaws == hw::JawState::open || gripper.opening_since.has_value(),
      .spin_radps = gripper.spin_radps,
      .opening_since = gripper.opening_since,
      .freed_at = gripper.freed_at,
  };
}

std::optional<servo::ArmObservation> observe_arm(const hw::ArmState& arm) {
  if (!heard(arm.stamp)) return std::nullopt;
  return servo::ArmObservation{.stamp = arm.stamp,
                               .folded = arm.position == hw::ArmPosition::folded,
                               .unfolded = arm.position == hw::ArmPosition::unfolded};
}

std::optional<servo::GyroObservation> observe_gyro(const hw::GyroState& gyro) {
  if (!heard(gyro.stamp)) return std::nullopt;
  return servo::GyroObservation{.stamp = gyro.stamp, .rate_radps = gyro.rate_radps, .valid = gyro.valid};
}

std::optional<servo::OperatorObservation> observe_switch(const hw::OperatorSwitchState& operator_switch) {
  if (!heard(operator_switch.stamp)) return std::nullopt;
  return servo::OperatorObservation{.stamp = operator_switch.stamp, .held = operator_switch.held};
}

}  // namespace

ThrowerLoop::ThrowerLoop(const ThrowerDevices& devices, ThrowerEyes eyes, servo::Thrower thrower,
                         servo::Supervisor supervisor)
    : devices_(devices), eyes_(std::move(eyes)), thrower_(std::move(thrower)), supervisor_(std::move(supervisor)) {}

std::optional<std::string> ThrowerLoop::arm(Stamp now) {
  devices_.operator_switch.step(now);
  auto refused = supervisor_.arm(observe(now));
  refusal_ = refused.value_or("");
  return refused;
}

void ThrowerLoop::step(Stamp now, Duration dt) {
  if (release_due_) let_go(now);
  devices_.drive.step(now);
  devices_.gripper.step(now);
  devices_.arm.step(now);
  devices_.gyro.at_rest(stands(devices_.drive.state()));
  devices_.gyro.step(now);
  devices_.operator_switch.step(now);
  eyes_.look(command_.camera, devices_.near_camera, devices_.low_camera, now, low_view_hint());

  if (!thrower_.finished()) note_errors();  // afterwards nobody sends set-points, and the drives say so
  const servo::ThrowerObservation seen = observe(now);
  command_ = supervisor_.permit(seen, thrower_.step(seen, dt), dt);
  apply(command_, now);
}

void ThrowerLoop::note_errors() {
  for (const auto& error : errors_of(devices_)) {
    const auto same = [&](const hw::DeviceError& e) { return e.device == error->device && e.since == error->since; };
    if (error && std::ranges::none_of(device_errors_, same)) device_errors_.push_back(*error);
  }
}

servo::ThrowerObservation ThrowerLoop::observe(Stamp now) const {
  return {.now = now,
          .wheels = observe_wheels(devices_.drive.state()),
          .gyro = observe_gyro(devices_.gyro.state()),
          .gripper = observe_gripper(devices_.gripper.state()),
          .arm = observe_arm(devices_.arm.state()),
          .near_view = eyes_.near_view(),
          .low_view = eyes_.low_view(),
          .operator_switch = observe_switch(devices_.operator_switch.state()),
          .device_error = first_error(devices_),
          .safety_stop = safety_stop()};
}

std::optional<std::string> ThrowerLoop::safety_stop() const {
  if (supervisor_.reason()) return supervisor_.reason();
  if (stopped_by_team_) return stopped_by_team_;
  if (supervisor_.state() == servo::Supervision::disarmed) return refusal_;
  return std::nullopt;
}

void ThrowerLoop::stop(const std::string& reason) {
  if (!stopped_by_team_) stopped_by_team_ = reason;
}

// The width and the rough place are known since the near view; what the filter believes confines the search.
vision::LowViewPrediction ThrowerLoop::low_view_hint() const {
  vision::LowViewPrediction hint;
  if (!eyes_.near_view() || !eyes_.near_view()->ok) return hint;
  const servo::ThrowerDiagnosis& belief = thrower_.diagnosis();
  hint.sheet_width_m = eyes_.near_view()->sheet_width_m;
  const double x_m =
      eyes_.low_view() && eyes_.low_view()->ok ? eyes_.low_view()->body.x_m : eyes_.near_view()->body.x_m;
  hint.body =
      PlanarPose{.x_m = x_m, .y_m = vision::rules::tee_to_hog_m - belief.hog_distance_m, .yaw_rad = belief.yaw_rad};
  constexpr double lateral_sigma_m = 0.1;  // the offset wanders by centimetres between two looks
  hint.body_sigma = {.x_m = lateral_sigma_m, .y_m = belief.hog_distance_sigma_m, .yaw_rad = belief.yaw_sigma_rad};
  return hint;
}

void ThrowerLoop::apply(const servo::ThrowerCommand& command, Stamp now) {
  switch (command.drive.order) {
    case servo::DriveOrder::off:
      break;
    case servo::DriveOrder::enable:
      devices_.drive.enable();
      break;
    case servo::DriveOrder::velocity:
      devices_.drive.command({command.drive.left_radps, command.drive.right_radps}, now);
      break;
    case servo::DriveOrder::quick_stop:
      devices_.drive.quick_stop();
      break;
  }
  switch (command.arm) {
    case servo::ArmOrder::hold:
      break;
    case servo::ArmOrder::fold:
      devices_.arm.fold();
      break;
    case servo::ArmOrder::unfold:
      devices_.arm.unfold();
      break;
  }
  apply_jaws(command.gripper, now);
}

void ThrowerLoop::apply_jaws(const servo::GripperCommand& command, Stamp now) {
  if (command.release) {
    if (releasing_) return;
    releasing_ = true;
    release_due_ = now + command.release_in;
    if (*release_due_ <= now) let_go(now);
    return;
  }
  devices_.gripper.spin(command.spin_radps);
  if (command.trial == trial_) return;
  trial_ = command.trial;
  if (trial_ == servo::JawTrial::none) return;
  if (trial_ == servo::JawTrial::open) {
    devices_.gripper.release();
  } else {
    devices_.gripper.grip();
  }
  devices_.gripper.step(now);  // at once, as a release is
}

// At once: a control period is a centimetre.
void ThrowerLoop::let_go(Stamp now) {
  release_due_.reset();
  devices_.gripper.release();
  devices_.gripper.step(now);
}

}  // namespace hogline
