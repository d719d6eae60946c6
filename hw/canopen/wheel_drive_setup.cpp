#include "hw/canopen/wheel_drive_setup.hpp"

#include "hw/canopen/cob_id.hpp"
#include "hw/canopen/wheel_pdos.hpp"
#include "hw/canopen/wheel_units.hpp"

namespace hogline::hw {
namespace {

std::uint32_t milliseconds(Duration span) {
  return static_cast<std::uint32_t>(std::chrono::duration_cast<std::chrono::milliseconds>(span).count());
}

void append(std::vector<SdoWrite>& to, const std::vector<SdoWrite>& writes) {
  to.insert(to.end(), writes.begin(), writes.end());
}

}  // namespace

std::vector<SdoWrite> wheel_drive_setup(const WheelConfig& wheel, const DriveTiming& timing, std::uint8_t master_node) {
  const std::uint8_t node = wheel.node;
  const std::uint32_t master_watch = (std::uint32_t{master_node} << 16) | milliseconds(timing.heartbeat_timeout);

  std::vector<SdoWrite> writes{
      {{0x1016, 1}, master_watch, 4},                                             // watch our heartbeat
      {{0x6007, 0}, 3, 2},                                                        // connection lost: quick stop
      {{0x605A, 0}, 6, 2},                                                        // quick stop: ramp 6085, then hold
      {{0x605E, 0}, 2, 2},                                                        // fault: quick-stop ramp
      {{0x6085, 0}, WheelUnits{wheel}.acceleration(wheel.quick_stop_radps2), 4},  // the ramp
      {{0x1017, 0}, milliseconds(timing.heartbeat_period), 2},                    // its heartbeat
      {{0x6060, 0}, static_cast<std::uint32_t>(cyclic_sync_velocity_mode), 1},    // mode
      {{0x60C2, 1}, milliseconds(timing.control_period), 1},                      // interpolation time ...
      {{0x60C2, 2}, static_cast<std::uint8_t>(-3), 1},                            // ... in 10^-3 s
  };

  append(writes, pdo_mapping_sequence(
                     wheel_command_pdo_config(node, static_cast<std::uint16_t>(milliseconds(timing.rpdo_timeout)))));
  append(writes, pdo_mapping_sequence(wheel_status_pdo_config(node)));
  append(writes, pdo_mapping_sequence(wheel_position_pdo_config(node)));

  // What a manufacturer may have switched on by default would load the bus and could command the drive.
  for (const int number : {2, 3, 4})
    writes.push_back(pdo_disable(PdoDirection::receive, number, rpdo_cob_id(number, node)));
  for (const int number : {3, 4})
    writes.push_back(pdo_disable(PdoDirection::transmit, number, tpdo_cob_id(number, node)));
  return writes;
}

}  // namespace hogline::hw
