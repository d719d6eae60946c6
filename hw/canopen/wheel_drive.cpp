#include "hw/canopen/wheel_drive.hpp"

#include "hw/canopen/drive_pdos.hpp"
#include "hw/canopen/drive_setup.hpp"

namespace hogline::hw {

WheelDrive::WheelDrive(const WheelConfig& wheel, const TwoWheelDriveConfig& config)
    : units_(gearing(wheel)),
      node_(identity(wheel), config.timing, wheel_setup(wheel, config.timing, config.master_node),
            cyclic_sync_velocity_mode, units_.velocity_units(config.plausibility.standstill_radps)),
      check_(config.plausibility, wheel.max_speed_radps) {}

void WheelDrive::boot(Stamp now) {
  check_.restart();
  node_.boot(now);
}

void WheelDrive::on_frame(const StampedCanFrame& received, Stamp now) {
  if (const auto travel = node_.on_frame(received, now)) {
    check_.on_feedback(units_.travel_rad(travel->from, travel->to), speed_radps(), travel->dt);
  }
}

void WheelDrive::step(Stamp now) {
  const bool was_operational = node_.operational();
  node_.step(now);
  if (!node_.operational()) return;
  if (!was_operational) return check_.restart();
  if (node_.following()) {
    check_.on_following(target_radps_, speed_radps(), now);
  } else {
    check_.on_not_following();
  }
  if (check_.problem()) node_.fail(DeviceErrorKind::implausible, *check_.problem(), now);
}

std::optional<CanFrame> WheelDrive::command(Cia402Goal goal, double target_radps, Stamp now) {
  const std::optional<Cia402Command> controlword = node_.control(goal, now);
  if (!controlword) return std::nullopt;
  target_radps_ = node_.following() ? target_radps : 0.0;
  return encode(DriveCommandPdo{static_cast<std::uint16_t>(*controlword), units_.velocity(target_radps_)}, node_.id());
}

}  // namespace hogline::hw
