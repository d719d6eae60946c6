// A virtual bus on a stepped clock, with an adapter and devices on it: what the benches of wheels and head share.
#pragma once

#include <functional>
#include <optional>

#include "hw/clock.hpp"
#include "hw/drive_phase.hpp"
#include "hw/sim/cia402_drive_device.hpp"
#include "hw/sim/virtual_can_bus.hpp"

namespace hogline::hw::test {

using namespace std::chrono_literals;

class CanBench {
 public:
  explicit CanBench(const sim::VirtualCanBusConfig& bus_config) : bus(clock, bus_config) {}
  virtual ~CanBench() = default;
  CanBench(const CanBench&) = delete;
  CanBench& operator=(const CanBench&) = delete;

  /// One millisecond of the world; the adapter takes part in every fifth, unless its loop is held up.
  virtual void tick() = 0;
  /// The adapter's.
  virtual DrivePhase phase() const = 0;

  Stamp now() const { return clock.now(); }
  void run(Duration span) {
    for (Duration t{0}; t < span; t += 1ms) tick();
  }
  /// Runs until the condition holds, and says how long it took; nothing if it never did within the limit.
  std::optional<Duration> run_until(const std::function<bool()>& condition, Duration limit) {
    for (Duration t{0}; t <= limit; t += 1ms) {
      if (condition()) return t;
      tick();
    }
    return std::nullopt;
  }
  std::optional<Duration> run_until(DrivePhase wanted, Duration limit) {
    return run_until([this, wanted] { return phase() == wanted; }, limit);
  }

  SteppedClock clock{Stamp{1000s}};
  sim::VirtualCanBus bus;
  CanBus& master = bus.make_endpoint();
  bool loop_stalled = false;

 protected:
  void advance() {
    clock.advance(1ms);
    ++ticks_;
  }
  bool period_due() const { return ticks_ % 5 == 0 && !loop_stalled; }

 private:
  int ticks_ = 0;
};

/// The standards' drive that both benches have, in the units of its encoder and of its velocity objects.
inline sim::Cia402DriveConfig drive_device(std::uint8_t node, std::uint32_t product_code, const char* name) {
  return {.identity = {.node = node,
                       .device_type = 0x00020192,
                       .vendor_id = 0x00C0FFEE,
                       .product_code = product_code,
                       .revision = 0x10001,
                       .serial = node,
                       .name = name},
          .axis = {.bandwidth_radps = 120.0, .dead_time_s = 0.002, .velocity_window_s = 0.004},
          .switch_on_time_s = 0.05};
}

}  // namespace hogline::hw::test
