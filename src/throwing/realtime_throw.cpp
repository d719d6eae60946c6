#include "src/throwing/realtime_throw.hpp"

#include <pthread.h>
#include <sched.h>

#include <mutex>
#include <thread>

#include "src/throwing/throw_recorder.hpp"
#include "src/throwing/vision_thread.hpp"

namespace hogline {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr Duration rink_step = std::chrono::milliseconds(1);
constexpr int rink_priority = 20;
constexpr int device_priority = 15;   // control waits for the Modbus devices' answers
constexpr int control_priority = 10;  // a rink that stands still has no news for control
constexpr int vision_priority = 1;
constexpr std::uint32_t velocity_pdo = 0x200;  // RPDO1 and its node (CiA 301, predefined connection set)

/// The wall clock, in the rink's time.
class WallClock final : public hw::Clock {
 public:
  explicit WallClock(Stamp start) : offset_(start - SteadyClock::now()) {}
  Stamp now() const override { return SteadyClock::now() + offset_; }
  SteadyClock::time_point wall(Stamp stamp) const { return stamp - offset_; }

 private:
  Duration offset_;
};

/// Asks to run before other programs. Refused without the right to (ulimit -r, CAP_SYS_NICE): then it runs as others
/// do.
bool run_first(int priority) {
  const sched_param parameters{.sched_priority = priority};
  return ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameters) == 0;
}

/// Threads begin with the priority of the one that begins them: the simulated devices' shall answer as devices do, not
/// when a busy machine has time.
class DevicePriority {
 public:
  DevicePriority() : first_(run_first(device_priority)) {}
  ~DevicePriority() {
    const sched_param ordinary{.sched_priority = 0};
    if (first_) ::pthread_setschedparam(::pthread_self(), SCHED_OTHER, &ordinary);
  }
  DevicePriority(const DevicePriority&) = delete;
  DevicePriority& operator=(const DevicePriority&) = delete;

 private:
  bool first_;
};

/// Steps the rink to the clock until it is stopped.
class RinkThread {
 public:
  RinkThread(hw::sim::Rink& rink, const WallClock& clock, std::mutex& devices)
      : thread_([&rink, &clock, &devices](const std::stop_token& stop) {
          run_first(rink_priority);
          while (!stop.stop_requested()) {
            {
              const std::lock_guard lock(devices);
              while (rink.now() + rink_step <= clock.now()) rink.step(rink_step);
            }
            std::this_thread::sleep_until(clock.wall(rink.now() + rink_step));
          }
        }) {}

 private:
  std::jthread thread_;
};

/// From frames to the CAN frames that carry the first command which knew them. A command is sent by the drives' next
/// step: what is on its way is what the period before decided. Used under the devices' lock.
class CommandWatch {
 public:
  CommandWatch(hw::sim::VirtualCanBus& bus, int node) : bus_(bus) {
    bus_.set_tap([this, id = velocity_pdo + static_cast<std::uint32_t>(node)](const hw::StampedCanFrame& seen) {
      if (seen.frame.id == id) sent(seen.stamp);
    });
  }
  ~CommandWatch() { bus_.set_tap({}); }
  CommandWatch(const CommandWatch&) = delete;
  CommandWatch& operator=(const CommandWatch&) = delete;

  void before_step() { on_its_way_ = decided_; }
  void after_step(const ThrowerEyes& eyes, Stamp now) {
    for (const auto* view : {&eyes.near_view(), &eyes.low_view()}) {
      if (*view && (!decided_ || (*view)->stamp > decided_->frame)) decided_ = Known{(*view)->stamp, now};
    }
  }
  const LatencyRecord& from_frame() const { return from_frame_; }
  const LatencyRecord& from_look() const { return from_look_; }

 private:
  struct Known {
    Stamp frame{};
    Stamp look{};
  };
  void sent(Stamp at) {
    if (!on_its_way_ || (last_ && on_its_way_->frame <= *last_)) return;
    last_ = on_its_way_->frame;
    from_frame_.add(at - on_its_way_->frame);
    from_look_.add(at - on_its_way_->look);
  }

  hw::sim::VirtualCanBus& bus_;
  std::optional<Known> decided_;
  std::optional<Known> on_its_way_;
  std::optional<Stamp> last_;
  LatencyRecord from_frame_;
  LatencyRecord from_look_;
};

}  // namespace

ThrowOutcome throw_in_real_time(const ThrowRequest& request, const Progress& progress) {
  std::optional<DevicePriority> devices_first(std::in_place);
  SimulatedRobot robot(simulated_rig(request), request.scenario, 1);
  const Duration period = request.rig.drive.timing.control_period;
  boot(robot, period);
  devices_first.reset();

  const Stamp start = robot.rink().now();
  VisionSeer vision(*request.rig.rig.near_camera, *request.rig.rig.low_camera, Looking::following);
  OracleSeer oracle = oracle_of(robot, request.rig);
  SheetSeer& seer = request.eyes == Eyes::oracle ? static_cast<SheetSeer&>(oracle) : vision;
  ThrowRecorder recorder(request, robot, start);
  CommandWatch commands(robot.rink().bus(), request.rig.drive.left.node);
  LatencyRecord late;
  RealtimeFigures figures;

  const WallClock clock(start);
  std::mutex devices;
  std::optional<RinkThread> rink(std::in_place, robot.rink(), clock, devices);
  std::optional<VisionThread> looking(std::in_place, seer, robot.devices().near_camera, robot.devices().low_camera,
                                      clock, [] { run_first(vision_priority); });
  const ThrowerDevices d = robot.devices();
  const LookTimes no_wait{};  // a look that comes out of its thread is done
  ThrowerLoop loop(
      {d.drive, d.gripper, d.arm, d.gyro, looking->near_camera(), looking->low_camera(), d.operator_switch, clock},
      ThrowerEyes(looking->seer(), no_wait), servo::Thrower(request.rig.thrower, request.order, start),
      servo::Supervisor(request.rig.thrower));
  {
    const std::lock_guard lock(devices);
    loop.arm(clock.now());
  }

  std::optional<bool> first;
  std::thread control([&] {
    first = run_first(control_priority);
    Stamp last = start;
    for (Stamp due = start + period;; due += period) {
      if (const auto release = loop.release_due(); release && *release < due) {
        std::this_thread::sleep_until(clock.wall(*release));
        const std::lock_guard lock(devices);
        loop.let_go(clock.now());
      }
      std::this_thread::sleep_until(clock.wall(due));
      const std::lock_guard lock(devices);
      const Stamp now = clock.now();
      late.add(now - due);
      recorder.before(now, loop.thrower());
      commands.before_step();
      loop.step(now, now - last);
      commands.after_step(loop.eyes(), now);
      recorder.after(now, loop.thrower(), progress);
      last = now;
      due = std::max(due, now - period);  // what is lost is lost
      if (recorder.robot_done(now, loop.thrower())) return;
    }
  });
  control.join();
  figures.looks = looking->looks();
  looking.reset();
  rink.reset();

  // Nobody controls any more: the stone may slide faster than the clock.
  while (recorder.stone_slides(robot.rink().now())) robot.rink().step(period);
  ThrowOutcome outcome = recorder.outcome(loop, vision);
  figures.commands = commands.from_frame().size();
  figures.frame_to_command_p50_ms = commands.from_frame().quantile_ms(0.5);
  figures.frame_to_command_p99_ms = commands.from_frame().quantile_ms(0.99);
  figures.look_to_command_p50_ms = commands.from_look().quantile_ms(0.5);
  figures.look_to_command_p99_ms = commands.from_look().quantile_ms(0.99);
  figures.periods = late.size();
  figures.late_p99_ms = late.quantile_ms(0.99);
  figures.late_max_ms = late.quantile_ms(1.0);
  figures.scheduled_first = first.value_or(false);
  outcome.result.realtime = figures;
  return outcome;
}

}  // namespace hogline
