#include "hw/canopen/drive_setup.hpp"

#include <algorithm>

#include "hw/canopen/axis_units.hpp"
#include "hw/canopen/cob_id.hpp"
#include "hw/canopen/drive_pdos.hpp"

namespace hogline::hw {
namespace {

constexpr std::uint32_t position_window_time_ms = 20;

std::uint32_t milliseconds(Duration span) {
  return static_cast<std::uint32_t>(std::chrono::duration_cast<std::chrono::milliseconds>(span).count());
}

void append(std::vector<SdoWrite>& to, const std::vector<SdoWrite>& writes) {
  to.insert(to.end(), writes.begin(), writes.end());
}

// 605A is 2 and not 6, so that quick stop active can only be left towards switch on disabled: with 5..8 an old
// controlword 000F, let loose by a bus that was stuck, would enable the drive again (transition 16).
std::vector<SdoWrite> safety_writes(std::uint32_t quick_stop_ramp, const DriveTiming& timing,
                                    std::uint8_t master_node) {
  const std::uint32_t master_watch = (std::uint32_t{master_node} << 16) | milliseconds(timing.heartbeat_timeout);
  return {
      {{0x1016, 1}, master_watch, 4},                           // watch our heartbeat
      {{0x6007, 0}, 3, 2},                                      // connection lost: quick stop
      {{0x605A, 0}, 2, 2},                                      // quick stop: ramp 6085, then no power
      {{0x605E, 0}, 2, 2},                                      // fault: quick-stop ramp
      {{0x6085, 0}, quick_stop_ramp, 4},                        // the ramp
      {{0x1017, 0}, milliseconds(timing.heartbeat_period), 2},  // its heartbeat
  };
}

std::vector<SdoWrite> mode_writes(std::int8_t mode, const DriveTiming& timing) {
  return {
      {{0x6060, 0}, static_cast<std::uint8_t>(mode), 1},
      {{0x60C2, 1}, milliseconds(timing.control_period), 1},  // interpolation time ...
      {{0x60C2, 2}, static_cast<std::uint8_t>(-3), 1},        // ... in 10^-3 s
  };
}

std::vector<SdoWrite> common_pdo_writes(std::uint8_t node, const DriveTiming& timing) {
  const auto watchdog_ms = static_cast<std::uint16_t>(milliseconds(timing.rpdo_timeout));
  std::vector<SdoWrite> writes = pdo_mapping_sequence(command_pdo_config(node, watchdog_ms));
  append(writes, pdo_mapping_sequence(status_pdo_config(node)));
  append(writes, pdo_mapping_sequence(position_pdo_config(node)));
  return writes;
}

// What a manufacturer may have switched on by default would load the bus and could command the drive.
void disable_others(std::vector<SdoWrite>& writes, std::uint8_t node, int first_unused_rpdo) {
  for (int number = first_unused_rpdo; number <= 4; ++number)
    writes.push_back(pdo_disable(PdoDirection::receive, number, rpdo_cob_id(number, node)));
  for (const int number : {3, 4})
    writes.push_back(pdo_disable(PdoDirection::transmit, number, tpdo_cob_id(number, node)));
}

// 607D in the drive's own sense: a drive that turns the other way has its limits exchanged.
std::vector<SdoWrite> profile_writes(const HeadAxisConfig& axis) {
  const AxisUnits units(axis.gearing);
  const std::int32_t a = axis.zero_counts + units.counts(axis.min_rad);
  const std::int32_t b = axis.zero_counts + units.counts(axis.max_rad);
  return {
      {{0x607D, 1}, static_cast<std::uint32_t>(std::min(a, b)), 4},  // software position limits
      {{0x607D, 2}, static_cast<std::uint32_t>(std::max(a, b)), 4},
      {{0x6081, 0}, units.speed(axis.max_speed_radps), 4},  // profile: speed, ramps
      {{0x6083, 0}, units.acceleration(axis.acceleration_radps2), 4},
      {{0x6084, 0}, units.acceleration(axis.acceleration_radps2), 4},
      {{0x6067, 0}, static_cast<std::uint32_t>(std::abs(units.counts(axis.tolerance_rad))), 4},  // target reached
      {{0x6068, 0}, position_window_time_ms, 2},
  };
}

bool is_cob_id(ObjectAddress address) {
  const bool communication =
      (address.index >= 0x1400 && address.index < 0x1600) || (address.index >= 0x1800 && address.index < 0x1A00);
  return communication && address.sub == 1;
}

}  // namespace

std::vector<SdoWrite> wheel_setup(const WheelConfig& wheel, const DriveTiming& timing, std::uint8_t master_node) {
  const std::uint32_t ramp = AxisUnits{gearing(wheel)}.acceleration(wheel.quick_stop_radps2);
  std::vector<SdoWrite> writes = safety_writes(ramp, timing, master_node);
  append(writes, mode_writes(cyclic_sync_velocity_mode, timing));
  append(writes, common_pdo_writes(wheel.node, timing));
  disable_others(writes, wheel.node, 2);
  return writes;
}

std::vector<SdoWrite> head_axis_setup(const HeadAxisConfig& axis, const DriveTiming& timing, std::uint8_t master_node) {
  const std::uint32_t ramp = AxisUnits{axis.gearing}.acceleration(axis.quick_stop_radps2);
  std::vector<SdoWrite> writes = safety_writes(ramp, timing, master_node);
  append(writes, profile_writes(axis));
  append(writes, mode_writes(profile_position_mode, timing));
  append(writes, common_pdo_writes(axis.identity.node, timing));
  append(writes, pdo_mapping_sequence(target_pdo_config(axis.identity.node)));
  disable_others(writes, axis.identity.node, 3);
  return writes;
}

std::vector<SdoExpectation> expected_after(const std::vector<SdoWrite>& writes) {
  std::vector<SdoExpectation> expected;
  for (const SdoWrite& write : writes) {
    const std::uint32_t size_mask = write.size == 4 ? 0xFFFFFFFF : (1u << (8 * write.size)) - 1;
    const std::uint32_t mask = is_cob_id(write.address) ? size_mask & ~0x60000000u : size_mask;
    const SdoExpectation held{write.address, write.value & mask, mask, write.optional};
    const auto earlier = std::find_if(expected.begin(), expected.end(),
                                      [&](const SdoExpectation& e) { return e.address == write.address; });
    if (earlier == expected.end()) {
      expected.push_back(held);
    } else {
      *earlier = held;
    }
  }
  return expected;
}

}  // namespace hogline::hw
