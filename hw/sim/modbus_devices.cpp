#include "hw/sim/modbus_devices.hpp"

#include <algorithm>

namespace hogline::hw::sim {

namespace {

template <typename Device>
ModbusUnit unit_of(Device& device, int holding_count, int input_count) {
  return {
      .unit = Device::unit,
      .holding_start = Device::holding_start,
      .holding_count = holding_count,
      .input_start = Device::input_start,
      .input_count = input_count,
      .write = [&device](int address, std::span<const std::uint16_t> values) { return device.write(address, values); },
      .read_inputs =
          [&device](std::span<std::uint16_t> inputs) { std::ranges::copy(device.inputs(), inputs.begin()); }};
}

}  // namespace

ModbusDevices::ModbusDevices(const GripperScenario& gripper, const SpinBeltScenario& belt, const ArmScenario& arm,
                             std::uint64_t seed, Stamp start)
    : jaws_(gripper, seed, start),
      belt_(belt, start),
      arm_(arm, start),
      station_({unit_of(jaws_, 3, 3), unit_of(belt_, 4, 8), unit_of(arm_, 4, 8)}) {}

ModbusServer& ModbusDevices::server() {
  if (!server_) {
    server_ = std::make_unique<ModbusServer>(station_, mutex_);
    if (stopped_) server_->stop();
  }
  return *server_;
}

void ModbusDevices::serve_tcp(int port) { server_ = std::make_unique<ModbusServer>(station_, mutex_, port); }

void ModbusDevices::stop() {
  stopped_ = true;
  if (server_) server_->stop();
}

void ModbusDevices::restart() {
  if (stopped_) ++life_;
  stopped_ = false;
  if (server_) server_->restart();
}

void ModbusDevices::set_faults(const ModbusServerFaults& faults) {
  const std::lock_guard lock(mutex_);
  station_.set_faults(faults);
}

ModbusReply ModbusDevices::take(ModbusStationLine& line, std::span<const std::uint8_t> bytes) {
  const std::lock_guard lock(mutex_);
  return station_.take(line, bytes);
}

void ModbusDevices::step(Stamp now) {
  const std::lock_guard lock(mutex_);
  jaws_.step(now);
  belt_.step(now);
  arm_.step(now);
}

void ModbusDevices::stone_between(bool between) {
  const std::lock_guard lock(mutex_);
  jaws_.stone_between(between);
}

ModbusDevices::Effects ModbusDevices::effects() const {
  const std::lock_guard lock(mutex_);
  return {.stone_in_jaws = jaws_.stone_in_jaws(),
          .stone_free_at = jaws_.free_at(),
          .belt_radps = belt_.speed_radps(),
          .arm_unfolded = arm_.unfolded()};
}

}  // namespace hogline::hw::sim
