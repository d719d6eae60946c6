#include "hw/sim/axis_device.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::hw::sim {

namespace {

constexpr int illegal_address = 2;
constexpr int illegal_value = 3;
constexpr int device_failure = 4;
constexpr std::uint16_t reset_fault = 3;

// One step of a value towards its target, no faster than rate.
double approach(double value, double target, double largest_step) {
  return value + std::clamp(target - value, -largest_step, largest_step);
}

}  // namespace

AxisDevice::AxisDevice(std::uint16_t kind, double watchdog_s, Stamp start)
    : kind_(kind), watchdog_time_(from_seconds(watchdog_s)), now_(start), refreshed_at_(start) {}

int AxisDevice::write(int address, std::span<const std::uint16_t> values) {
  if (address == holding_start && values.size() == 3) {
    return write_command(values[0], values[1], static_cast<std::int16_t>(values[2]));
  }
  if (address != holding_start + 3 || values.size() != 1) return illegal_address;
  if (values[0] != watchdog_) {
    refreshed_ = true;
    refreshed_at_ = now_;
  }
  watchdog_ = values[0];
  return 0;
}

int AxisDevice::write_command(std::uint16_t sequence, std::uint16_t command, std::int16_t argument) {
  if (sequence == 0) return illegal_value;
  if (sequence == sequence_) return 0;
  if (!fresh()) return device_failure;
  if (command == reset_fault) {
    if (argument != 0) return illegal_value;
    if (fault_ != 0) return device_failure;
    halt();
    faulted_ = false;
  } else {
    if (faulted_ && command != 0) return device_failure;
    if (carry_out(command, argument) == Verdict::illegal_value) return illegal_value;
  }
  sequence_ = sequence;
  tripped_ = false;
  return 0;
}

void AxisDevice::step(Stamp now) {
  const double dt_s = seconds(now - now_);
  now_ = now;
  if (!fresh()) tripped_ = true;
  if (tripped_ || faulted_) halt();
  advance(dt_s);
}

void AxisDevice::set_fault(std::uint16_t code) {
  fault_ = code;
  faulted_ = faulted_ || code != 0;
}

void AxisDevice::power_cycle() {
  halt();
  refreshed_ = false;
  tripped_ = true;
  faulted_ = false;
  fault_ = sequence_ = watchdog_ = 0;
}

std::array<std::uint16_t, 8> AxisDevice::inputs() const {
  const auto now = readings();
  const unsigned status = (now.moving ? 0x01U : 0U) | (now.at_target ? 0x02U : 0U) | (tripped_ ? 0x04U : 0U) |
                          (faulted_ ? 0x08U : 0U) | (now.folded ? 0x10U : 0U) | (now.unfolded ? 0x20U : 0U);
  const auto watchdog_ms = std::chrono::duration_cast<std::chrono::milliseconds>(watchdog_time_).count();
  return {kind_,     sequence_,
          watchdog_, static_cast<std::uint16_t>(status),
          fault_,    static_cast<std::uint16_t>(now.actual),
          now.limit, static_cast<std::uint16_t>(watchdog_ms)};
}

BeltDevice::BeltDevice(const SpinBeltScenario& scenario, Stamp start)
    : AxisDevice(0x4231, scenario.watchdog_s, start), scenario_(scenario) {}

AxisDevice::Verdict BeltDevice::carry_out(std::uint16_t command, std::int16_t argument) {
  const double wanted_radps = 1e-3 * argument;
  if (command > 1 || std::abs(wanted_radps) > scenario_.max_speed_radps) return Verdict::illegal_value;
  target_radps_ = command == 1 ? wanted_radps : 0.0;
  return Verdict::carried_out;
}

void BeltDevice::advance(double dt_s) {
  speed_radps_ = approach(speed_radps_, target_radps_, scenario_.acceleration_radps2 * dt_s);
}

AxisDevice::Readings BeltDevice::readings() const {
  return {.moving = speed_radps_ != 0.0,
          .at_target = speed_radps_ == target_radps_,
          .actual = static_cast<std::int16_t>(std::lround(speed_radps_ * 1e3)),
          .limit = static_cast<std::uint16_t>(std::lround(scenario_.max_speed_radps * 1e3))};
}

ArmDevice::ArmDevice(const ArmScenario& scenario, Stamp start)
    : AxisDevice(0x4131, scenario.watchdog_s, start),
      scenario_(scenario),
      place_(scenario.unfolded_at_start ? 1.0 : 0.0),
      target_(place_) {}

AxisDevice::Verdict ArmDevice::carry_out(std::uint16_t command, std::int16_t argument) {
  if (command > 2 || argument != 0) return Verdict::illegal_value;
  if (command == 0) halt();
  if (command == 1) target_ = 0.0;
  if (command == 2) target_ = 1.0;
  return Verdict::carried_out;
}

void ArmDevice::advance(double dt_s) { place_ = approach(place_, target_, dt_s / scenario_.travel_time_s); }

AxisDevice::Readings ArmDevice::readings() const {
  return {.moving = place_ != target_,
          .at_target = place_ == target_ && (place_ == 0.0 || place_ == 1.0),
          .folded = place_ == 0.0,
          .unfolded = place_ == 1.0,
          .actual = static_cast<std::int16_t>(std::lround(place_ * 10000.0))};
}

}  // namespace hogline::hw::sim
