#include "hw/sim/rink.hpp"

#include <algorithm>
#include <cassert>
#include <numbers>

namespace hogline::hw::sim {

namespace {

constexpr Duration substep_span = std::chrono::milliseconds(1);
// Longer than any camera's latency and the age at which a frame is still asked for.
constexpr Duration history_span = std::chrono::seconds(1);

// Each part of the rink draws from its own sequence, so that one part's draws do not shift another's.
enum class Part : std::uint64_t { modbus = 2, gyro = 3 };
std::uint64_t seed_of(const Scenario& scenario, Part part) {
  return scenario.seed * 4 + static_cast<std::uint64_t>(part);
}

Cia402DriveConfig with_loop(Cia402DriveConfig device, const DriveScenario& drive) {
  device.axis.bandwidth_radps = 2.0 * std::numbers::pi * drive.bandwidth_hz;
  device.axis.dead_time_s = drive.dead_time_s;
  return device;
}

}  // namespace

Rink::Wheel::Wheel(const WheelRig& rig, const DriveScenario& drive, CanBus& bus)
    : device(bus, with_loop(rig.device, drive)), motor_per_wheel(rig.direction * rig.gear_ratio) {}

void Rink::Wheel::step(Stamp now, double dt_s, double wheel_radps) {
  command = device.step(now, dt_s, wheel_radps * motor_per_wheel);
}

std::optional<double> Rink::Wheel::axis_radps() const {
  switch (command.power) {
    case AxisPower::unpowered:
      return std::nullopt;
    case AxisPower::driven:
      return command.speed_radps / motor_per_wheel;
    case AxisPower::braked:
      return 0.0;
  }
  return std::nullopt;
}

Rink::Rink(const RinkConfig& config, Stamp start)
    : start_(start),
      clock_(start),
      bus_(clock_, config.bus),
      program_can_(bus_.make_endpoint()),
      left_(config.left, config.scenario.drive, bus_.make_endpoint()),
      right_(config.right, config.scenario.drive, bus_.make_endpoint()),
      modbus_(config.scenario.gripper, config.scenario.belt, config.scenario.arm,
              seed_of(config.scenario, Part::modbus), start),
      gyro_(config.scenario.gyro, seed_of(config.scenario, Part::gyro), start),
      world_(config.scenario, start),
      history_(history_span) {
  history_.add(world_.truth());
}

void Rink::step(Duration span) {
  assert(span > Duration{});
  for (const Stamp end = now() + span; now() < end;) substep(std::min(substep_span, Duration(end - now())));
}

// What was seen before it was carried is another place: no exposure reaches back over it.
void Rink::put_back(const PlanarPose& body, int team, double handle_rad) {
  world_.put_back(body, team, handle_rad);
  history_.clear();
  history_.add(truth());
}

void Rink::substep(Duration span) {
  bus_.deliver();

  const auto effects = modbus_.effects();
  clock_.advance(span);
  world_.step({.axes = {left_.axis_radps(), right_.axis_radps()},
               .belt_radps = effects.belt_radps,
               .stone_free_at = effects.stone_free_at,
               .stone_in_jaws = effects.stone_in_jaws,
               .arm_unfolded = effects.arm_unfolded},
              now());

  left_.step(now(), seconds(span), truth().left_wheel_radps);
  right_.step(now(), seconds(span), truth().right_wheel_radps);
  bus_.deliver();
  modbus_.stone_between(world_.stone_between_jaws());
  modbus_.step(now());
  gyro_.step(now(), truth().twist.yaw_radps);
  history_.add(truth());
}

}  // namespace hogline::hw::sim
