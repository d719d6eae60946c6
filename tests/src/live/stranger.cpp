// Somebody on the link who is not what he says he is: he sends heartbeats and orders under a robot's name, whatever the
// answer, fifty times a second, and tells what he hears.
//   stranger ROBOT DOMAIN KEYS_FOLDER        without keys: "-" as the folder
// `stop` and `back` on stdin: he calls an emergency stop, and takes it back. Lines of JSON on stdout, as hogline's own
// programs tell: "heard", "forbidden", "ordered", "no link". It runs until it is killed.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <thread>

#include "hw/clock.hpp"
#include "hw/link/dds_team_link.hpp"
#include "src/live/input_lines.hpp"

using namespace hogline;
using namespace hogline::hw;
using namespace hogline::hw::link;

namespace {

constexpr const char* kinds[] = {"order", "state", "release", "board", "track", "outcome", "heartbeat", "stop"};

void tell_once(const std::string& event, const std::string& what) {
  static std::set<std::string> told;
  if (!told.insert(event + what).second) return;
  const double t_s = seconds(SteadyClock{}.now().time_since_epoch());
  std::printf("{\"t_s\": %.6f, \"who\": \"stranger\", \"event\": \"%s\", \"what\": \"%s\"}\n", t_s, event.c_str(),
              what.c_str());
}

class Stranger {
 public:
  explicit Stranger(const LinkConfig& config)
      : robot_(config.robot),
        link_(config, clock_.now(), TeamTime{std::chrono::system_clock::now().time_since_epoch()}) {}

  void step() {
    const Stamp now = clock_.now();
    while (const auto received = link_.receive(now)) hear(received->message, link_.team_time(now));
    HeartbeatMessage beat;
    for (const auto& [robot, echo] : echoes_) beat.echoes.push_back(echo);
    send(beat, now);
    ShotOrderMessage order;
    order.thrower_session = thrower_session_;
    order.shot = 1;
    order.speed_mps = 3.0;
    order.spin_radps = 1.5;
    send(order, now);
    const auto line = input_.line();
    if (line) send(EmergencyStopMessage{.origin = {}, .pressed = *line == "stop", .reason = "a stranger's"}, now);
  }

 private:
  void send(const TeamMessage& message, Stamp now) {
    const TeamSendResult result = link_.send(message, now);
    const bool forbidden = result == TeamSendResult::forbidden;
    if (forbidden || result == TeamSendResult::sent)
      tell_once(forbidden ? "forbidden" : "sent", kinds[message.index()]);
  }

  void hear(const TeamMessage& message, TeamTime at) {
    const Origin& from = origin_of(message);
    if (from.robot == robot_) return;
    tell_once("heard", kinds[message.index()] + (" of " + from.robot));
    if (from.robot == "thrower") thrower_session_ = from.session;
    if (std::holds_alternative<HeartbeatMessage>(message))
      echoes_[from.robot] = {.robot = from.robot, .session = from.session, .sent = from.stamp, .heard = at};
  }

  std::string robot_;
  SteadyClock clock_;
  DdsTeamLink link_;
  InputLines input_;
  std::map<std::string, Echo> echoes_;
  std::uint64_t thrower_session_ = 1;
};

}  // namespace

int main(int count, char** arguments) {
  if (count != 4) return 2;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  LinkConfig config;
  config.robot = arguments[1];
  config.domain = static_cast<std::uint32_t>(std::strtoul(arguments[2], nullptr, 10));
  if (arguments[3] != std::string("-")) config.security = LinkSecurity{.folder = arguments[3]};
  try {
    for (Stranger stranger(config);; std::this_thread::sleep_for(std::chrono::milliseconds{20})) stranger.step();
  } catch (const LinkError& error) {
    tell_once("no link", error.what());
    for (;;) std::this_thread::sleep_for(std::chrono::seconds{1});
  }
}
