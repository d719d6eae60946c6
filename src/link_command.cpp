#include "src/link_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <thread>

#include "hw/clock.hpp"
#include "hw/link/dds_team_link.hpp"
#include "hw/link/team_watch.hpp"
#include "src/config/config_error.hpp"
#include "src/config/device_rig.hpp"
#include "src/exit_status.hpp"
#include "src/live/process.hpp"

namespace hogline {
namespace {

using namespace std::chrono_literals;
using hw::link::PeerState;
using hw::link::Presence;

const char* word(Presence presence) {
  switch (presence) {
    case Presence::unheard:
      return "not heard";
    case Presence::there:
      return "there";
    case Presence::silent:
      return "silent";
  }
  return "";
}

nlohmann::ordered_json json_of(const std::string& robot, const PeerState& state) {
  nlohmann::ordered_json line{{"robot", robot}, {"presence", word(state.presence)}};
  const bool heard = state.presence != Presence::unheard;
  line["age_s"] = heard ? nlohmann::ordered_json(seconds(state.age)) : nullptr;
  line["restarts"] = state.restarts;
  line["heartbeats_missed"] = state.missed;
  line["clock_offset_s"] = state.clock ? nlohmann::ordered_json(seconds(state.clock->offset)) : nullptr;
  line["clock_offset_bound_s"] = state.clock ? nlohmann::ordered_json(seconds(state.clock->bound)) : nullptr;
  return line;
}

std::string text_of(const std::string& robot, const PeerState& state) {
  std::string line = fmt::format("  {:<12} {}", robot, word(state.presence));
  if (state.presence == Presence::unheard) return line;
  line += fmt::format(", last heartbeat {:.0f} ms ago, {} missed, {} restarts", 1e3 * seconds(state.age), state.missed,
                      state.restarts);
  if (!state.clock) return line + ", clock not compared yet";
  return line + fmt::format(", clock {:+.3f} ms (+-{:.3f})", 1e3 * seconds(state.clock->offset),
                            1e3 * seconds(state.clock->bound));
}

class Listener {
 public:
  explicit Listener(const hw::link::LinkConfig& config)
      : link_(config, clock_.now(), hw::TeamTime{std::chrono::system_clock::now().time_since_epoch()}),
        watch_({.self = config.robot, .peers = config.peers, .silent_after = hw::link::heartbeat_deadline}) {}

  void listen(Duration span) {
    const Stamp end = clock_.now() + span;
    for (Stamp beat = clock_.now(); beat < end; beat += hw::link::heartbeat_period) {
      for (; clock_.now() < beat; std::this_thread::sleep_for(1ms)) hear();
      if (asked_to_end()) break;
      hw::HeartbeatMessage heartbeat;
      heartbeat.echoes = watch_.echoes();
      link_.send(std::move(heartbeat), clock_.now());
    }
    hear();
  }
  PeerState peer(const std::string& robot) const { return watch_.peer(robot, clock_.now()); }
  hw::TeamLinkState state() const { return link_.state(); }
  long strangers() const { return watch_.strangers(); }

 private:
  void hear() {
    const Stamp now = clock_.now();
    while (const auto received = link_.receive(now)) {
      if (const auto* heartbeat = std::get_if<hw::HeartbeatMessage>(&received->message))
        watch_.heard(*heartbeat, now, link_.team_time(now), link_.state().session);
    }
  }

  hw::SteadyClock clock_;
  hw::link::DdsTeamLink link_;
  hw::link::TeamWatch watch_;
};

}  // namespace

int run_link(const LinkOptions& options) {
  const config::DeviceRig rig = config::load_device_rig(options.rig);
  if (!rig.link) {
    throw config::ConfigError(rig.rig.file, 0, "link", "", "missing; this rig declares no link to other robots");
  }
  listen_for_the_end();
  Listener listener(*rig.link);
  listener.listen(from_seconds(options.seconds));

  bool all_there = true;
  if (!options.json) fmt::print("{} on {}, DDS domain {}\n", rig.link->robot, rig.link->interface, rig.link->domain);
  for (const std::string& robot : rig.link->peers) {
    const PeerState state = listener.peer(robot);
    all_there = all_there && state.presence == Presence::there;
    fmt::print("{}\n", options.json ? json_of(robot, state).dump() : text_of(robot, state));
  }
  if (!options.json) {
    fmt::print("  {} messages sent, {} received, {} malformed, {} under another's name, {} heartbeats of strangers\n",
               listener.state().sent, listener.state().received, listener.state().malformed, listener.state().impostors,
               listener.strangers());
  }
  return all_there ? ExitStatus::success : ExitStatus::not_achieved;
}

}  // namespace hogline
