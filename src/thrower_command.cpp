#include "src/thrower_command.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <thread>

#include "hw/link/dds_team_link.hpp"
#include "hw/local_switch/local_switch.hpp"
#include "src/config/config_error.hpp"
#include "src/exit_status.hpp"
#include "src/live/live_thrower.hpp"
#include "src/live/process.hpp"
#include "src/steel/steel_robot.hpp"
#include "src/throwing/vision_seer.hpp"

namespace hogline {
namespace {

using namespace std::chrono_literals;

constexpr Duration longest_end = 15s;
constexpr Duration say_period = 50ms;
constexpr Duration free_first = 500ms;

void check(const config::ThrowerRig& rig) {
  if (!rig.link) throw config::ConfigError(rig.rig.file, 0, "link", "", "missing; the thrower takes its orders there");
  if (rig.link->robot != "thrower" || rig.link->peers != std::vector<std::string>{"skip"}) {
    throw config::ConfigError(rig.rig.file, 0, "link.robot", rig.link->robot,
                              "must be thrower, and its peer skip: who throws, and who orders");
  }
  if (rig.operator_socket.empty()) {
    throw config::ConfigError(rig.rig.file, 0, "operator.socket", "",
                              "missing; without somebody who holds the switch nothing moves");
  }
}

// Steps the thrower to the clock until the end is asked for and the robot rests.
void run_control(LiveThrower& thrower, Duration period, ServiceManager& services) {
  const hw::SteadyClock clock;
  std::optional<Stamp> end_asked;
  Stamp last = clock.now();
  for (Stamp due = last + period;; due += period) {
    if (const auto release = thrower.release_due(); release && *release < due) {
      std::this_thread::sleep_until(*release);
      thrower.let_go(clock.now());
    }
    std::this_thread::sleep_until(due);
    const Stamp now = clock.now();
    thrower.step(now, now - last);
    services.alive(now);
    last = now;
    due = std::max(due, now - period);  // what is lost is lost
    if (asked_to_end()) {
      if (!end_asked) thrower.end();
      end_asked = end_asked.value_or(now);
      if (thrower.phase() != LivePhase::throwing || now - *end_asked > longest_end) return;
    }
  }
}

}  // namespace

int run_thrower(const ThrowerOptions& options) {
  listen_for_the_end();
  const config::ThrowerRig rig = config::load_thrower_rig(options.rig);
  check(rig);
  const hw::SteadyClock clock;
  ServiceManager services;
  run_first(control_priority);  // the link's threads, too: control must not wait for one that others hold up
  hw::link::DdsTeamLink link(*rig.link, clock.now(), hw::TeamTime{std::chrono::system_clock::now().time_since_epoch()});
  hw::LocalSwitch operator_switch(rig.operator_socket);
  run_first(device_priority);
  SteelRobot robot(rig, clock);
  const bool first = run_first(control_priority);
  const auto make_seer = [&rig]() -> std::unique_ptr<SheetSeer> {
    return std::make_unique<VisionSeer>(*rig.rig.near_camera, *rig.rig.low_camera, Looking::following);
  };
  LiveThrower thrower(rig, robot.devices(operator_switch), link, make_seer,
                      [&rig](const char* event, const std::string& what) { tell(rig.link->robot, event, what); });
  tell(rig.link->robot, "session",
       fmt::format("{}, {}", link.state().session, first ? "runs first" : "runs as other programs do"));
  services.ready("waits for its operator and for orders");
  run_control(thrower, rig.drive.timing.control_period, services);
  services.stopping();
  tell(rig.link->robot, "end", "");
  return ExitStatus::success;
}

int run_hold(const HoldOptions& options) {
  listen_for_the_end();
  const config::DeviceRig rig = config::load_device_rig(options.rig);
  if (rig.operator_socket.empty()) {
    throw config::ConfigError(rig.rig.file, 0, "operator.socket", "", "missing; this rig has no switch to hold");
  }
  hw::SwitchHand hand(rig.operator_socket);
  const hw::SteadyClock clock;
  const Stamp start = clock.now();
  bool heard = false;
  std::optional<std::string> told;
  for (Stamp due = start; !asked_to_end(); due += say_period) {
    const Duration since = due - start;
    if (options.seconds > 0.0 && since > free_first + from_seconds(options.seconds)) break;
    heard = hand.say(since > free_first);
    const std::string state = !heard ? "nobody listens" : since > free_first ? "pressed" : "heard";
    if (told != state) tell("operator", state, rig.operator_socket);
    told = state;
    std::this_thread::sleep_until(due + say_period);
  }
  heard = hand.say(false);
  tell("operator", heard ? "let go" : "nobody listens", rig.operator_socket);
  return heard ? ExitStatus::success : ExitStatus::not_achieved;
}

}  // namespace hogline
