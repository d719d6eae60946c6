// A machine of another vendor on the robots' link: it tells what it hears, and orders a shot when the thrower is there.
//   fast_dds_program DOMAIN SKIP_SESSION SKIP_SERIAL
// Lines on stdout: "thrower SESSION PHASE", "board OK STONES X0 Y0 TEAM0", "release SPEED". It runs until it is killed
// or its parent is gone.
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "tests/hw/link/fast_dds_machine.hpp"

using peer::Machine;
using peer::take;
using namespace eprosima::fastdds::dds;

namespace {

peer::ShotOrder order_of(const char* const* arguments, std::uint64_t thrower_session) {
  const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
  peer::ShotOrder order;
  order.header.sec = static_cast<std::int32_t>(since_1970 / std::chrono::seconds{1});
  order.header.nanosec = static_cast<std::uint32_t>(since_1970 % std::chrono::seconds{1} / std::chrono::nanoseconds{1});
  order.header.frame_id = "e";
  order.origin = {"skip", std::strtoull(arguments[2], nullptr, 10), std::strtoull(arguments[3], nullptr, 10)};
  order.thrower_session = thrower_session;
  order.shot = 5;
  order.speed_mps = 2.125;
  order.heading_rad = -0.0125;
  order.spin_radps = 1.5;
  return order;
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 4) return 2;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  Machine machine(static_cast<unsigned>(std::strtoul(arguments[1], nullptr, 10)));
  DataReader* states = machine.reader<peer::ThrowerState>("thrower_state", "ThrowerState");
  DataReader* boards = machine.reader<peer::Board>("board", "Board");
  DataReader* releases = machine.reader<peer::Release>("release", "Release");
  DataWriter* orders = machine.writer<peer::ShotOrder>("shot_order", "ShotOrder");
  bool ordered = false;
  for (const pid_t parent = getppid(); getppid() == parent; std::this_thread::sleep_for(std::chrono::milliseconds{5})) {
    take<peer::ThrowerState>(states, [&](const peer::ThrowerState& m) {
      std::printf("thrower %llu %u\n", static_cast<unsigned long long>(m.origin.session), m.phase);
      PublicationMatchedStatus matched;
      orders->get_publication_matched_status(matched);
      if (ordered || matched.current_count == 0) return;
      peer::ShotOrder order = order_of(arguments, m.origin.session);
      ordered = orders->write(&order);
      std::printf("ordered\n");
    });
    take<peer::Board>(boards, [&](const peer::Board& m) {
      const peer::Stone first = m.stones.empty() ? peer::Stone{} : m.stones[0];
      std::printf("board %d %zu %.3f %.3f %s\n", m.ok, m.stones.size(), first.x, first.y, first.team.c_str());
    });
    take<peer::Release>(releases, [&](const peer::Release& m) { std::printf("release %.4f\n", m.speed_mps); });
  }
  return 0;
}
