// From the release event to the skip that hears it, between two processes on the loopback interface:
//   hogline_link_latency [SECONDS]
// The thrower releases fifty times a second beside a whole robot's traffic; the skip looks as fast as it can, then once
// a control period, without security and with it. A table in Markdown on stdout.
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "hw/clock.hpp"
#include "hw/link/dds_team_link.hpp"
#include "hw/link/team_keys.hpp"
#include "tests/hw/link/example_messages.hpp"

using namespace hogline;
using namespace hogline::hw;
using namespace hogline::hw::link;
using namespace std::chrono_literals;

namespace {

const SteadyClock steady;

// One machine, one steady clock: both processes count their team time from the same zero.
TeamTime team_time_of(Stamp stamp) { return TeamTime{stamp.time_since_epoch() + 1'000'000'000s}; }

struct Way {
  const char* name;
  Duration look_period;
  std::string keys;
};

LinkConfig config(const std::string& robot, const Way& way) {
  LinkConfig config;
  config.robot = robot;
  config.domain = 211;
  if (!way.keys.empty()) config.security = LinkSecurity{.folder = way.keys};
  return config;
}

// The thrower's process: never returns.
[[noreturn]] void throw_for_ever(const Way& way) {
  const Stamp start = steady.now();
  DdsTeamLink link(config("thrower", way), start, team_time_of(start));
  const pid_t parent = getppid();
  for (Stamp due = start; getppid() == parent; due += 20ms) {
    std::this_thread::sleep_until(due);
    link.send(test::release(), steady.now());
    link.send(test::thrower_state(), steady.now());
    link.send(test::heartbeat(), steady.now());
  }
  std::_Exit(0);
}

struct Traffic {
  long packets = 0;
  long bytes = 0;
};

Traffic on_loopback() {
  Traffic traffic;
  std::ifstream("/sys/class/net/lo/statistics/tx_packets") >> traffic.packets;
  std::ifstream("/sys/class/net/lo/statistics/tx_bytes") >> traffic.bytes;
  return traffic;
}

double at(const std::vector<double>& sorted, double share) {
  return sorted[std::min(sorted.size() - 1, static_cast<std::size_t>(share * static_cast<double>(sorted.size())))];
}

void listen(const Way& way, Duration span) {
  const Stamp start = steady.now();
  DdsTeamLink link(config("skip", way), start, team_time_of(start));
  while (!link.receive(steady.now())) std::this_thread::sleep_for(1ms);

  std::vector<double> ages_ms;
  const Traffic before = on_loopback();
  const long received_before = link.state().received;
  const Stamp begin = steady.now();
  for (Stamp due = begin; due < begin + span; due = std::max(due + way.look_period, steady.now())) {
    std::this_thread::sleep_until(due);
    while (const auto heard = link.receive(steady.now())) {
      if (std::holds_alternative<ReleaseMessage>(heard->message))
        ages_ms.push_back(1e3 * seconds(link.team_time(steady.now()) - origin_of(heard->message).stamp));
    }
  }
  const double passed_s = seconds(steady.now() - begin);
  const Traffic after = on_loopback();
  std::sort(ages_ms.begin(), ages_ms.end());
  std::printf("| %s | %zu | %.2f | %.2f | %.2f | %.0f | %.0f | %.1f |\n", way.name, ages_ms.size(), at(ages_ms, 0.5),
              at(ages_ms, 0.99), ages_ms.back(),
              static_cast<double>(link.state().received - received_before) / passed_s,
              static_cast<double>(after.packets - before.packets) / passed_s,
              static_cast<double>(after.bytes - before.bytes) / passed_s / 1000.0);
}

// Each end in a process of its own, both born before either has threads.
void measure(const Way& way, Duration span) {
  std::fflush(stdout);
  const pid_t skip = fork();
  if (skip == 0) {
    const pid_t thrower = fork();
    if (thrower == 0) throw_for_ever(way);
    listen(way, span);
    std::fflush(stdout);
    std::_Exit(0);
  }
  waitpid(skip, nullptr, 0);
}

}  // namespace

int main(int count, char** arguments) {
  const Duration span = std::chrono::seconds(count > 1 ? std::max(1, std::atoi(arguments[1])) : 20);
  const auto keys = std::filesystem::temp_directory_path() / ("link_latency_keys." + std::to_string(getpid()));
  make_team_keys({.folder = keys.string(),
                  .domain = 211,
                  .members = {{"thrower", TeamRole::thrower}, {"skip", TeamRole::skip}},
                  .from = TeamTime{std::chrono::system_clock::now().time_since_epoch()}});
  std::puts(
      "| the skip looks | releases | p50 ms | p99 ms | longest ms | messages a second | packets a second | kB a second "
      "|\n"
      "|---|--:|--:|--:|--:|--:|--:|--:|");
  measure({"as fast as it can", 50us, ""}, span);
  measure({"200 times a second", 5ms, ""}, span);
  measure({"as fast as it can, with security", 50us, keys.string()}, span);
  measure({"200 times a second, with security", 5ms, keys.string()}, span);
  std::filesystem::remove_all(keys);
  return 0;
}
