#include "hw/sim/skip_rink.hpp"

#include <algorithm>
#include <cassert>
#include <numbers>

namespace hogline::hw::sim {
namespace {

constexpr Duration substep_span = std::chrono::milliseconds(1);
// Longer than any camera's latency and the age at which a frame is still asked for.
constexpr Duration history_span = std::chrono::seconds(1);
constexpr double turn_rad = 2.0 * std::numbers::pi;

Cia402DriveConfig with_loop(Cia402DriveConfig device, const DriveScenario& drive) {
  device.axis.bandwidth_radps = turn_rad * drive.bandwidth_hz;
  device.axis.dead_time_s = drive.dead_time_s;
  return device;
}

}  // namespace

SkipRink::Axis::Axis(const HeadAxisRig& axis, const DriveScenario& drive, double zero_error, CanBus& bus)
    : rig(axis), device(bus, with_loop(axis.device, drive)), zero_error_rad(zero_error) {
  device.axis().slip_encoder(rig.zero_counts / rig.device.position_counts_per_rev);  // begins at angle 0
}

double SkipRink::Axis::angle_rad() const {
  const double zero_rev = rig.zero_counts / rig.device.position_counts_per_rev;
  const double turned_rev = device.axis().position_rev() - zero_rev;
  return rig.direction * turned_rev * turn_rad / rig.gear_ratio + zero_error_rad;
}

// The axis follows its drive, and stands without it: the gear locks itself.
void SkipRink::Axis::step(Stamp now, double dt_s) {
  const AxisCommand command = device.step(now, dt_s, motor_radps);
  motor_radps = command.power == AxisPower::driven ? command.speed_radps : 0.0;
}

SkipRink::SkipRink(const SkipRinkConfig& config, Stamp start)
    : start_(start),
      clock_(start),
      bus_(clock_, config.bus),
      program_can_(bus_.make_endpoint()),
      pan_(config.pan, config.scenario.skip->head, config.scenario.skip->pan_zero_error_rad, bus_.make_endpoint()),
      tilt_(config.tilt, config.scenario.skip->head, config.scenario.skip->tilt_zero_error_rad, bus_.make_endpoint()),
      field_(config.scenario.stone, config.scenario.sheet.width_m, config.standing, config.scenario.seed * 4 + 2,
             start),
      delivery_(config.delivery),
      history_(history_span) {
  remember();
}

void SkipRink::step(Duration span) {
  assert(span > Duration{});
  for (const Stamp end = now() + span; now() < end;) substep(std::min(substep_span, Duration(end - now())));
}

void SkipRink::deliver(const FieldStone& stone, Stamp released) {
  thrown_ = static_cast<std::size_t>(field_.add(stone));
  released_ = released;
}

void SkipRink::take_all_off() {
  thrown_.reset();
  released_.reset();
  field_.take_all_off();
}

void SkipRink::begin_throw(std::uint64_t seed) {
  thrown_.reset();
  released_.reset();
  field_.begin_throw(seed);
}

void SkipRink::substep(Duration span) {
  bus_.deliver();
  clock_.advance(span);
  if (delivery_ && now() >= start_ + delivery_->after) {
    field_.step(start_ + delivery_->after);
    thrown_ = static_cast<std::size_t>(field_.add(delivery_->stone));
    released_ = start_ + delivery_->after;
    delivery_.reset();
  }
  field_.step(now());
  pan_.step(now(), seconds(span));
  tilt_.step(now(), seconds(span));
  bus_.deliver();
  remember();
}

void SkipRink::remember() {
  for (const Axis* axis : {&pan_, &tilt_}) {
    const double angle = axis->angle_rad();
    least_room_rad_ = std::min({least_room_rad_, angle - axis->rig.min_rad, axis->rig.max_rad - angle});
  }
  history_.add({now(), head(), field_.stones(), thrown_, released_});
}

}  // namespace hogline::hw::sim
