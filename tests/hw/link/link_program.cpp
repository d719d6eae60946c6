// A robot that says everything it may, fifty times a second, and tells what it hears, once for each kind and robot:
//   link_program ROBOT DOMAIN KEYS_FOLDER
// It runs until it is killed or its parent is gone.
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <thread>

#include "hw/clock.hpp"
#include "hw/link/dds_team_link.hpp"
#include "tests/hw/link/example_messages.hpp"

using namespace hogline::hw;
using namespace hogline::hw::link;

namespace {

void tell_once(const std::string& line) {
  static std::set<std::string> told;
  if (told.insert(line).second) std::printf("%s\n", line.c_str());
}

void say_everything(DdsTeamLink& link, hogline::Stamp now) {
  for (const TeamMessage& message : test::one_of_each()) {
    if (link.send(message, now) == TeamSendResult::forbidden) tell_once("forbidden " + std::to_string(message.index()));
  }
}

void tell_what_is_heard(DdsTeamLink& link, hogline::Stamp now) {
  static std::map<std::string, std::set<std::uint64_t>> sessions;
  while (const auto heard = link.receive(now)) {
    const Origin& origin = origin_of(heard->message);
    sessions[origin.robot].insert(origin.session);
    tell_once("heard " + std::to_string(heard->message.index()) + " " + origin.robot);
    tell_once("heard sessions " + std::to_string(sessions[origin.robot].size()) + " of " + origin.robot);
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 4) return 2;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  LinkConfig config;
  config.robot = arguments[1];
  config.domain = static_cast<std::uint32_t>(std::strtoul(arguments[2], nullptr, 10));
  config.security = LinkSecurity{.folder = arguments[3]};
  const SteadyClock clock;
  try {
    DdsTeamLink link(config, clock.now(), TeamTime{std::chrono::system_clock::now().time_since_epoch()});
    for (const pid_t parent = getppid(); getppid() == parent;
         std::this_thread::sleep_for(std::chrono::milliseconds{20})) {
      say_everything(link, clock.now());
      tell_what_is_heard(link, clock.now());
      if (link.state().impostors > 0) tell_once("impostors");
    }
  } catch (const LinkError& error) {
    std::printf("no link: %s\n", error.what());
    return 1;
  }
  return 0;
}
