#include "src/live_skip_command.hpp"

#include <fmt/format.h>

#include <numbers>
#include <sstream>
#include <thread>

#include "hw/link/dds_team_link.hpp"
#include "src/config/config_error.hpp"
#include "src/config/device_rig.hpp"
#include "src/exit_status.hpp"
#include "src/live/input_lines.hpp"
#include "src/live/live_skip.hpp"
#include "src/live/process.hpp"
#include "src/skip/skip_vision.hpp"

namespace hogline {
namespace {

hw::link::LinkConfig link_of(const std::string& path) {
  const config::DeviceRig rig = config::load_device_rig(path);
  if (!rig.link) throw config::ConfigError(path, 0, "link", "", "missing; the skip orders its shots there");
  if (rig.link->robot != "skip" || rig.link->peers != std::vector<std::string>{"thrower"}) {
    throw config::ConfigError(path, 0, "link.robot", rig.link->robot,
                              "must be skip, and its peer thrower: who orders, and who throws");
  }
  return *rig.link;
}

// "order 2.1 0.5 -1.5"
std::string order(const std::string& line, LiveSkip& skip, Stamp now) {
  std::istringstream words(line);
  std::string verb;
  servo::ShotOrder shot;
  double heading_deg = 0.0;
  double spin_radps = 0.0;
  if (!(words >> verb >> shot.speed_mps >> heading_deg >> spin_radps)) return "order SPEED_MPS HEADING_DEG SPIN_RADPS";
  shot.heading_rad = heading_deg * std::numbers::pi / 180.0;
  shot.curl = spin_radps < 0.0 ? servo::Curl::clockwise : servo::Curl::counter_clockwise;
  shot.spin_radps = std::abs(spin_radps);
  return skip.order(shot, now);
}

void obey(const std::string& line, LiveSkip& skip, Stamp now, bool& quit) {
  std::string refusal;
  if (line == "begin") {
    skip.begin(now);
  } else if (line.starts_with("order")) {
    refusal = order(line, skip, now);
  } else if (line == "quit") {
    quit = true;
  } else {
    refusal = "'" + line + "': there are begin, order, quit";
  }
  if (!refusal.empty()) tell("skip", "refused", refusal);
}

}  // namespace

int run_live_skip(const LiveSkipOptions& options) {
  listen_for_the_end();
  const hw::link::LinkConfig link_config = link_of(options.rig);
  const config::SkipRig rig = config::load_skip_rig(options.rig);
  const hw::SteadyClock clock;
  ServiceManager services;
  const bool first = run_first(control_priority);  // the link's threads, too: control must not wait for one of them
  hw::link::DdsTeamLink link(link_config, clock.now(),
                             hw::TeamTime{std::chrono::system_clock::now().time_since_epoch()});
  SteelSkip robot(rig, clock);
  LiveSkip skip(
      rig, robot, link, clock, [&rig] { return std::make_unique<SkipVision>(rig); },
      [](const char* event, const std::string& what) { tell("skip", event, what); });
  tell("skip", "session",
       fmt::format("{}, {}", link.state().session, first ? "runs first" : "runs as other programs do"));
  services.ready("waits for its operator");
  InputLines input;
  const Duration period = rig.head.timing.control_period;
  Stamp last = clock.now();
  bool quit = false;
  for (Stamp due = last + period; !quit && !asked_to_end(); due += period) {
    std::this_thread::sleep_until(due);
    const Stamp now = clock.now();
    skip.step(now, now - last);
    services.alive(now);
    last = now;
    due = std::max(due, now - period);  // what is lost is lost
    if (const auto line = input.line()) obey(*line, skip, now, quit);
  }
  robot.head().stop();
  robot.head().step(clock.now());
  services.stopping();
  tell("skip", "end", "");
  return ExitStatus::success;
}

}  // namespace hogline
