// The adapters in a thread of their own. Nothing here waits for a time: each test waits for a state.
#include "hw/modbus/modbus_worker.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "hw/sim/modbus_devices.hpp"
#include "tests/hw/modbus/adapter_config.hpp"

namespace hogline::hw {
namespace {

using namespace std::chrono_literals;

// A clock that a test moves while another thread reads it.
class SharedClock final : public Clock {
 public:
  Stamp now() const override { return Stamp{Duration{ticks_.load()}}; }
  void advance(Duration span) { ticks_ += span.count(); }

 private:
  std::atomic<Duration::rep> ticks_{0};
};

// The clock runs much faster than the machine, so the deadlines in its time are long.
constexpr Duration silence_limit = 100000s;
constexpr AdapterPace unhurried{
    .poll_period = 1ms, .echo_deadline = 3600s, .activation_deadline = 3600s, .silence_limit = silence_limit};

class Rig {
 public:
  explicit Rig(Duration order_age_limit = 100000s) : order_age_limit_(order_age_limit) {}

  // Devices and clock go on by one control period, as fast as the machine allows; the worker ticks meanwhile.
  template <typename Reached>
  void run_until(Reached&& reached) {
    while (!reached()) {
      clock.advance(5ms);
      devices.step(clock.now());
      std::this_thread::yield();
    }
  }
  void run(Duration span) {
    const Stamp end = clock.now() + span;
    run_until([&] { return clock.now() >= end; });
  }

  Duration order_age_limit_;
  SharedClock clock;
  sim::ModbusDevices devices{{.opening_delay_s = 0.075,
                              .opening_jitter_s = 0.002,
                              .motion_delay_s = 0.02,
                              .holds_stone_at_start = true,
                              .activation_time_s = 0.5,
                              .full_stroke_time_s = 0.6},
                             {.acceleration_radps2 = 4.0, .max_speed_radps = 3.0, .watchdog_s = 1e6},
                             {.travel_time_s = 1.5, .unfolded_at_start = false, .watchdog_s = 1e6},
                             7,
                             Stamp{}};
  ModbusWorker worker{{.session = {.line = {.line = ModbusTcp{"127.0.0.1", devices.port()}, .response_timeout = 500ms},
                                   .reconnect_delay = 1ms},
                       .gripper = gripper_config(2.5, unhurried),
                       .arm = arm_config(unhurried),
                       .tick = 100us,
                       .order_age_limit = order_age_limit_},
                      clock};
};

TEST(ModbusWorker, carries_orders_and_gives_states) {
  Rig rig;
  auto& gripper = rig.worker.gripper();
  auto& arm = rig.worker.arm();
  rig.run_until([&] { return gripper.state().jaws == JawState::holding; });
  gripper.spin(1.2);
  arm.unfold();
  rig.run_until([&] { return gripper.state().spin_radps > 1.1; });
  rig.run_until([&] { return arm.state().position == ArmPosition::unfolded; });
  gripper.release();
  rig.run_until([&] { return gripper.state().jaws == JawState::open; });
  EXPECT_FALSE(rig.devices.effects().stone_in_jaws);
  EXPECT_TRUE(gripper.state().opening_since);
  EXPECT_FALSE(gripper.state().error) << gripper.state().error->what;
}

TEST(ModbusWorker, a_dead_line_never_holds_up_the_caller_and_moves_nothing_when_it_is_back) {
  Rig rig;
  auto& gripper = rig.worker.gripper();
  rig.run_until([&] { return gripper.state().jaws == JawState::holding; });
  rig.devices.stop();
  rig.clock.advance(silence_limit + 1s);
  rig.run_until([&] { return gripper.state().error.has_value(); });
  for (int i = 0; i < 100000; ++i) gripper.release();  // each returns at once, and none is kept
  rig.run(1s);
  rig.devices.restart();
  const auto exchanged = [&] { return gripper.state().stamp; };
  const Stamp restarted = rig.clock.now();
  rig.run_until([&] { return exchanged() > restarted || rig.clock.now() > restarted + 3600s; });
  EXPECT_TRUE(rig.devices.effects().stone_in_jaws);
  EXPECT_TRUE(gripper.state().error) << "latched";

  gripper.rearm();
  rig.run_until([&] { return !gripper.state().error; });
  rig.run_until([&] { return gripper.state().jaws == JawState::holding && exchanged() > restarted; });
  EXPECT_TRUE(rig.devices.effects().stone_in_jaws) << "re-arming alone moves nothing";
  gripper.release();
  rig.run_until([&] { return gripper.state().jaws == JawState::open; });
}

TEST(ModbusWorker, a_release_that_waited_too_long_for_the_line_is_dropped_and_reported) {
  Rig rig(40s);
  auto& gripper = rig.worker.gripper();
  rig.run_until([&] { return gripper.state().jaws == JawState::holding; });
  rig.devices.stall();
  // Until the worker is in an exchange, which takes half a second of real time to fail.
  rig.run_until([&] { return rig.clock.now() - gripper.state().stamp > 20s; });
  gripper.release();
  rig.clock.advance(30s);
  gripper.release();  // repeating it makes it no younger
  rig.clock.advance(11s);
  rig.devices.set_faults({});
  rig.run_until([&] { return gripper.state().error.has_value(); });
  EXPECT_NE(gripper.state().error->what.find("waited too long"), std::string::npos) << gripper.state().error->what;
  const Stamp dropped = rig.clock.now();
  rig.run_until([&] { return gripper.state().stamp > dropped; });
  EXPECT_TRUE(rig.devices.effects().stone_in_jaws);
}

TEST(ModbusWorker, each_port_is_rearmed_by_itself) {
  Rig rig;
  auto& gripper = rig.worker.gripper();
  auto& arm = rig.worker.arm();
  rig.run_until([&] { return gripper.state().jaws == JawState::holding; });
  rig.run_until([&] { return arm.state().position == ArmPosition::folded; });
  rig.devices.inject([](auto& jaws, auto&, auto& axis) {
    jaws.set_fault(0x0E);
    axis.set_fault(2);
  });
  rig.run_until([&] { return gripper.state().error && arm.state().error; });
  rig.devices.inject([](auto& jaws, auto&, auto& axis) {
    jaws.set_fault(0);
    axis.set_fault(0);
  });
  arm.rearm();
  rig.run_until([&] { return !arm.state().error; });
  EXPECT_TRUE(gripper.state().error) << "it was not asked";
  gripper.rearm();
  rig.run_until([&] { return !gripper.state().error; });
  EXPECT_TRUE(rig.devices.effects().stone_in_jaws);
}

}  // namespace
}  // namespace hogline::hw
