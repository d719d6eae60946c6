#include "hw/sim/cia402_drive_device.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace hogline::hw::sim {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

// A stop is complete when the axis stands, not when its ramp has ended: motor revolutions per second.
constexpr double standstill_rps = 0.05;

/// Allows exactly these values of an option code.
template <typename... Values>
auto only(Values... allowed) {
  return [=](std::int64_t value) -> std::uint32_t { return ((value == allowed) || ...) ? 0 : 0x06090030; };
}

std::int32_t to_int32(double value) {
  // Two's complement wrap, as a counter does.
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(static_cast<std::int64_t>(std::floor(value))));
}

double toward(double from, double to, double by) {
  return from < to ? std::min(from + by, to) : std::max(from - by, to);
}

}  // namespace

Cia402DriveDevice::Cia402DriveDevice(CanBus& bus, const Cia402DriveConfig& config)
    : config_(config), communication_(bus, config.identity, *this), axis_(config.axis) {
  add_drive_objects();
}

void Cia402DriveDevice::add_drive_objects() {
  ObjectDictionary& objects = communication_.objects();
  const ObjectAccess ro = ObjectAccess::read_only;
  const ObjectAccess rw = ObjectAccess::read_write;
  objects.add(0x6007, 0, 2, rw, 1).guard = only(0, 1, 2, 3);
  objects.add(0x603F, 0, 2, ro, 0, true);
  objects.add(0x6040, 0, 2, rw, 0, true).guard = [this](std::int64_t) -> std::uint32_t {
    controlword_is_old_ = false;
    return 0;
  };
  objects.add(0x6041, 0, 2, ro, 0, true);
  objects.add(0x605A, 0, 2, rw, 2).guard = only(0, 1, 2, 5, 6);
  objects.add(0x605E, 0, 2, rw, 2).guard = only(0, 1, 2);
  objects.add(0x6060, 0, 1, rw, 0, true).guard = [this](std::int64_t mode) -> std::uint32_t {
    const bool has = mode == 0 || mode == 3 || mode == 9 || (mode == 1 && config_.profile_position);
    return has ? 0 : 0x06090030;
  };
  objects.add(0x6061, 0, 1, ro, 0, true);
  objects.add(0x6064, 0, 4, ro, 0, true);
  objects.add(0x606C, 0, 4, ro, 0, true);
  const auto some = static_cast<std::int64_t>(std::llround(10.0 * config_.acceleration_units_per_rps2));
  for (const std::uint16_t ramp : std::array<std::uint16_t, 3>{0x6083, 0x6084, 0x6085}) {
    objects.add(ramp, 0, 4, rw, std::max<std::int64_t>(some, 1), true).guard = [](std::int64_t value) -> std::uint32_t {
      return static_cast<std::uint32_t>(value) == 0 ? 0x06090032 : 0;
    };
  }
  objects.add(0x60C2, 0, 1, ObjectAccess::constant, 2);
  objects.add(0x60C2, 1, 1, rw, 1);
  objects.add(0x60C2, 2, 1, rw, -3).guard = only(-3, -4);
  objects.add(0x60FF, 0, 4, rw, 0, true);
  // Supported modes: profile velocity, cyclic velocity, perhaps profile position.
  objects.add(0x6502, 0, 4, ro, (1 << 2) | (1 << 8) | (config_.profile_position ? 1 : 0));
  if (config_.profile_position) add_profile_position_objects();
}

void Cia402DriveDevice::add_profile_position_objects() {
  ObjectDictionary& objects = communication_.objects();
  const ObjectAccess rw = ObjectAccess::read_write;
  objects.add(0x607A, 0, 4, rw, 0, true);
  objects.add(0x607D, 0, 1, ObjectAccess::constant, 2);
  objects.add(0x607D, 1, 4, rw, std::numeric_limits<std::int32_t>::min());
  objects.add(0x607D, 2, 4, rw, std::numeric_limits<std::int32_t>::max());
  objects.add(0x6081, 0, 4, rw, 0, true);
  objects.add(0x6067, 0, 4, rw, 10);
  objects.add(0x6068, 0, 2, rw, 0);
}

// ---- what the communication says ----

void Cia402DriveDevice::on_reset() {
  state_ = State::not_ready;
  last_controlword_ = 0;
  controlword_is_old_ = false;
  demand_rps_ = 0.0;
}

void Cia402DriveDevice::on_communication_lost() {
  // What the lost master last said is no command any more: only a controlword that still arrives is.
  controlword_is_old_ = true;
  if (state_ != State::operation_enabled) return;
  switch (communication_.objects().get_signed(0x6007)) {
    case 1:
      raise_fault(0x8130);
      return;
    case 2:
      state_ = State::switch_on_disabled;
      return;
    case 3:
      start_quick_stop();
      return;
    default:
      return;
  }
}

void Cia402DriveDevice::start_quick_stop() {
  const std::int32_t option = communication_.objects().get_signed(0x605A);
  state_ = option == 0 ? State::switch_on_disabled : State::quick_stop_active;
}

// ---- faults a test pulls ----

void Cia402DriveDevice::raise_fault(std::uint16_t error_code) {
  communication_.objects().set(0x603F, 0, error_code);
  communication_.emergency(error_code, 0x01);
  const bool moving = state_ == State::operation_enabled || state_ == State::quick_stop_active;
  state_ = moving && communication_.objects().get_signed(0x605E) != 0 ? State::fault_reaction_active : State::fault;
}

void Cia402DriveDevice::kill(AxisPower axis_left) {
  communication_.set_power(false);
  dead_axis_ = axis_left;
}

void Cia402DriveDevice::power_cycle() { communication_.set_power(true); }

// ---- one step ----

AxisCommand Cia402DriveDevice::step(Stamp now, double dt_s, double axis_speed_radps) {
  axis_.turn(dt_s, axis_speed_radps);
  communication_.step(now);
  if (!communication_.powered()) return {dead_axis_, 0.0};
  if (state_ == State::not_ready && communication_.nmt() != CanopenDevice::Nmt::booting) {
    state_ = State::switch_on_disabled;
  }
  obey_controlword(axis_speed_radps);
  run_state(dt_s, axis_speed_radps);
  publish();
  return act(dt_s, axis_speed_radps);
}

void Cia402DriveDevice::obey_controlword(double axis_speed_radps) {
  if (controlword_is_old_) return;
  const auto word = static_cast<std::uint16_t>(communication_.objects().get(0x6040));
  const bool reset_edge = (word & 0x80) != 0 && (last_controlword_ & 0x80) == 0;
  if (state_ == State::operation_enabled) obey_set_point_bits(word);
  last_controlword_ = word;

  const bool voltage = (word & 0x02) != 0;
  const bool quick_stop = (word & 0x04) == 0;
  const bool switch_on = (word & 0x01) != 0;
  const bool enable = (word & 0x08) != 0;

  switch (state_) {
    case State::switch_on_disabled:
      if (voltage && !quick_stop && !switch_on) state_ = State::ready_to_switch_on;  // 2
      return;
    case State::ready_to_switch_on:
      switching_on_s_ = 0.0;
      if (!voltage || quick_stop) {
        state_ = State::switch_on_disabled;  // 7
      } else if (switch_on) {
        state_ = State::switched_on;  // 3
      }
      return;
    case State::switched_on:
      if (!voltage || quick_stop) {
        state_ = State::switch_on_disabled;  // 10
      } else if (!switch_on) {
        state_ = State::ready_to_switch_on;  // 6
      } else if (enable && switching_on_s_ >= config_.switch_on_time_s) {
        axis_.engage(axis_speed_radps);
        demand_rps_ = axis_speed_radps / two_pi;
        profile_.hold(position_counts());
        state_ = State::operation_enabled;  // 4
      }
      return;
    case State::operation_enabled:
      if (!voltage) {
        state_ = State::switch_on_disabled;  // 9
      } else if (quick_stop) {
        if (!faults.quick_stop_ignored) start_quick_stop();  // 11
      } else if (!switch_on) {
        state_ = State::ready_to_switch_on;  // 8
      } else if (!enable) {
        state_ = State::switched_on;  // 5
      }
      return;
    case State::quick_stop_active: {
      const bool may_resume = communication_.objects().get_signed(0x605A) >= 5;
      if (!voltage) {
        state_ = State::switch_on_disabled;  // 12
      } else if (may_resume && !quick_stop && switch_on && enable) {
        state_ = State::operation_enabled;  // 16
      }
      return;
    }
    case State::fault:
      if (!reset_edge) return;
      communication_.objects().set(0x603F, 0, 0);
      communication_.emergency(0, 0);
      state_ = State::switch_on_disabled;  // 15
      return;
    case State::not_ready:
    case State::fault_reaction_active:
      return;
  }
}

void Cia402DriveDevice::run_state(double dt_s, double axis_speed_radps) {
  ObjectDictionary& objects = communication_.objects();
  if (!faults.mode_never_confirmed) objects.set(0x6061, 0, objects.get_signed(0x6060));
  switching_on_s_ += dt_s;
  const bool stands = std::abs(axis_speed_radps) < standstill_rps * two_pi;

  switch (state_) {
    case State::operation_enabled:
      return run_enabled(dt_s);
    case State::quick_stop_active: {
      run_ramp(dt_s, quick_stop_deceleration());
      const bool stays = objects.get_signed(0x605A) >= 5;
      if (demand_rps_ == 0.0 && stands && !stays) state_ = State::switch_on_disabled;  // 12
      return;
    }
    case State::fault_reaction_active:
      run_ramp(dt_s, fault_deceleration());
      if (demand_rps_ == 0.0 && stands) state_ = State::fault;  // 14
      return;
    default:
      demand_rps_ = 0.0;
      return;
  }
}

void Cia402DriveDevice::obey_set_point_bits(std::uint16_t word) {
  if (communication_.objects().get_signed(0x6061) != 1 || faults.set_point_ignored) return;
  if ((word & 0x10) == 0) return profile_.withdraw();
  if ((last_controlword_ & 0x10) == 0) take_set_point(word);
}

// Bit 6: relative to where the axis is. A target beyond the software limits becomes the limit.
void Cia402DriveDevice::take_set_point(std::uint16_t word) {
  const ObjectDictionary& objects = communication_.objects();
  double target = objects.get_signed(0x607A);
  if ((word & 0x40) != 0) target += position_counts();
  const double lowest = objects.get_signed(0x607D, 1);
  const double highest = objects.get_signed(0x607D, 2);
  profile_.offer(std::clamp(target, lowest, highest), (word & 0x20) != 0);
}

double Cia402DriveDevice::position_counts() const {
  return static_cast<double>(axis_.encoder_counts()) / config_.axis.encoder_counts_per_rev *
         config_.position_counts_per_rev;
}

void Cia402DriveDevice::run_profile_position(double dt_s) {
  const ObjectDictionary& objects = communication_.objects();
  const double counts_per_unit = config_.position_counts_per_rev / config_.velocity_units_per_rps;
  const double counts_per_ramp_unit = config_.position_counts_per_rev / config_.acceleration_units_per_rps2;
  const PositionProfileLimits limits{.velocity = objects.get(0x6081) * counts_per_unit,
                                     .acceleration = objects.get(0x6083) * counts_per_ramp_unit,
                                     .deceleration = objects.get(0x6084) * counts_per_ramp_unit,
                                     .window = static_cast<double>(objects.get(0x6067)),
                                     .window_time_s = objects.get(0x6068) * 1e-3};
  const bool halt = (last_controlword_ & 0x100) != 0;
  demand_rps_ = profile_.step(dt_s, position_counts(), halt, limits) / config_.position_counts_per_rev;
}

void Cia402DriveDevice::run_enabled(double dt_s) {
  const ObjectDictionary& objects = communication_.objects();
  const double target_rps = objects.get_signed(0x60FF) / config_.velocity_units_per_rps;
  const std::int32_t mode = objects.get_signed(0x6061);
  if (mode != 1) profile_.hold(position_counts());
  switch (mode) {
    case 1:
      return run_profile_position(dt_s);
    case 9:
      demand_rps_ = target_rps;
      return;
    case 3: {
      const bool faster = std::abs(target_rps) > std::abs(demand_rps_);
      const double ramp = objects.get(faster ? 0x6083 : 0x6084) / config_.acceleration_units_per_rps2;
      demand_rps_ = toward(demand_rps_, target_rps, ramp * dt_s);
      return;
    }
    default:
      demand_rps_ = 0.0;
      return;
  }
}

void Cia402DriveDevice::run_ramp(double dt_s, double deceleration_rps2) {
  demand_rps_ = toward(demand_rps_, 0.0, deceleration_rps2 * dt_s);
}

double Cia402DriveDevice::quick_stop_deceleration() const {
  const ObjectDictionary& objects = communication_.objects();
  const std::int32_t option = objects.get_signed(0x605A);
  const bool slow_ramp = option == 1 || option == 5;
  return objects.get(slow_ramp ? 0x6084 : 0x6085) / config_.acceleration_units_per_rps2;
}

double Cia402DriveDevice::fault_deceleration() const {
  const ObjectDictionary& objects = communication_.objects();
  return objects.get(objects.get_signed(0x605E) == 1 ? 0x6084 : 0x6085) / config_.acceleration_units_per_rps2;
}

/// Bits 10 and 12 mean something else in each mode.
std::uint16_t Cia402DriveDevice::mode_bits() const {
  switch (communication_.objects().get_signed(0x6061)) {
    case 1: {
      const bool acknowledged = profile_.acknowledged() || faults.acknowledge_stuck;
      const bool reached = profile_.reached() || faults.reached_at_once;
      return static_cast<std::uint16_t>((reached ? 1u << 10 : 0u) | (acknowledged ? 1u << 12 : 0u));
    }
    case 9:
      return 1u << 12;  // follows the commanded velocity
    default:
      return 0;
  }
}

std::uint16_t Cia402DriveDevice::statusword() const {
  // Bit 4 voltage enabled, bit 9 remote: set whenever the drive is alive.
  constexpr std::uint16_t alive = 0x0210;
  switch (state_) {
    case State::not_ready:
      return alive | 0x00;
    case State::switch_on_disabled:
      return alive | 0x40;
    case State::ready_to_switch_on:
      return alive | 0x21;
    case State::switched_on:
      return alive | 0x23;
    case State::operation_enabled:
      return static_cast<std::uint16_t>(alive | 0x27 | mode_bits());
    case State::quick_stop_active:
      return alive | 0x07;
    case State::fault_reaction_active:
      return alive | 0x0F;
    case State::fault:
      return alive | 0x08;
  }
  return 0;
}

void Cia402DriveDevice::publish() {
  ObjectDictionary& objects = communication_.objects();
  if (!faults.statusword_stuck) objects.set(0x6041, 0, statusword());
  objects.set(0x6064, 0, to_int32(position_counts() * faults.position_scale));
  objects.set(0x606C, 0, std::llround(axis_.encoder_speed_rps() * config_.velocity_units_per_rps));
}

AxisCommand Cia402DriveDevice::act(double dt_s, double axis_speed_radps) {
  const bool driven = state_ == State::operation_enabled || state_ == State::quick_stop_active ||
                      state_ == State::fault_reaction_active;
  if (!driven) return {AxisPower::unpowered, 0.0};
  if (faults.speed_stuck) return {AxisPower::driven, axis_speed_radps};
  return {AxisPower::driven, axis_.follow(dt_s, demand_rps_ * two_pi)};
}

}  // namespace hogline::hw::sim
