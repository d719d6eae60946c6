// Another vendor's machine in the skip's place: it is heard, hears, and orders one shot of an armed thrower. Once that
// is thrown it sends the very same order again and again.
//   fast_dds_skip DOMAIN
// Lines on stdout, in JSON as hogline's own programs tell: "ordered", "thrower", "released". It runs until it is killed
// or its parent is gone.
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

#include "tests/hw/link/fast_dds_machine.hpp"

namespace {

using std::chrono::milliseconds;
using WallClock = std::chrono::system_clock;

peer::Time present() {
  const auto since_1970 = WallClock::now().time_since_epoch();
  return {static_cast<std::int32_t>(since_1970 / std::chrono::seconds{1}),
          static_cast<std::uint32_t>(since_1970 % std::chrono::seconds{1} / std::chrono::nanoseconds{1})};
}

void tell(const char* event, const std::string& what) {
  const double t_s = std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  std::printf("{\"t_s\": %.6f, \"who\": \"fast dds\", \"event\": \"%s\", \"what\": \"%s\"}\n", t_s, event,
              what.c_str());
}

peer::Header header_now() {
  const peer::Time t = present();
  return {t.sec, t.nanosec, "e"};
}

constexpr int stopped = 4;  // phase of a thrower state

class Skip {
 public:
  explicit Skip(unsigned domain)
      : machine_(domain),
        states_(machine_.reader<peer::ThrowerState>("thrower_state", "ThrowerState")),
        releases_(machine_.reader<peer::Release>("release", "Release")),
        heard_(machine_.reader<peer::Heartbeat>("heartbeat", "Heartbeat")),
        beats_(machine_.punctual_writer<peer::Heartbeat>("heartbeat", "Heartbeat")),
        orders_(machine_.writer<peer::ShotOrder>("shot_order", "ShotOrder")),
        session_(static_cast<std::uint64_t>(WallClock::now().time_since_epoch() / std::chrono::microseconds{1})) {}

  void step() {
    peer::take<peer::Heartbeat>(heard_, [&](const peer::Heartbeat& m) {
      if (m.origin.robot != "thrower") return;
      echo_ = peer::Echo{"thrower", m.origin.session, {m.header.sec, m.header.nanosec}, present()};
      ++beats_heard_;
    });
    beat();
    peer::take<peer::ThrowerState>(states_, [&](const peer::ThrowerState& m) {
      if (m.phase != phase_) tell("thrower", std::to_string(m.phase) + (m.armed ? " armed " : " ") + m.reason);
      phase_ = m.phase;
      const bool refused = ordered_ && m.order_serial == order_serial_ && m.phase == stopped && !m.reason.empty();
      if (refused) tell("refused", m.reason);
      ordered_ = ordered_ && !refused;
      if (!ordered_ && !released_ && m.armed && beats_heard_ > 20) order(m.origin.session);
    });
    peer::take<peer::Release>(releases_, [&](const peer::Release& m) {
      tell("released", std::to_string(m.speed_mps) + " " + std::to_string(m.hog_distance_m));
      released_ = true;
    });
    if (released_) orders_->write(&last_);
  }

 private:
  void beat() {
    peer::Heartbeat beat;
    beat.header = header_now();
    beat.origin = {"skip", session_, ++beat_serial_};
    if (echo_.session != 0) beat.echoes = {echo_};
    beats_->write(&beat);
  }

  void order(std::uint64_t thrower_session) {
    peer::ShotOrder order;
    order.header = header_now();
    order.origin = {"skip", session_, ++order_serial_};
    order.thrower_session = thrower_session;
    order.shot = 1;
    order.speed_mps = 2.25;
    order.spin_radps = -1.5;
    ordered_ = orders_->write(&order);
    last_ = order;
    tell("ordered", "2.25 m/s");
  }

  peer::Machine machine_;
  eprosima::fastdds::dds::DataReader* states_;
  eprosima::fastdds::dds::DataReader* releases_;
  eprosima::fastdds::dds::DataReader* heard_;
  eprosima::fastdds::dds::DataWriter* beats_;
  eprosima::fastdds::dds::DataWriter* orders_;
  std::uint64_t session_;
  std::uint64_t beat_serial_ = 0;
  int beats_heard_ = 0;
  int phase_ = -1;
  bool ordered_ = false;
  bool released_ = false;
  peer::ShotOrder last_;
  std::uint64_t order_serial_ = 0;
  peer::Echo echo_;
};

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  Skip skip(static_cast<unsigned>(std::strtoul(arguments[1], nullptr, 10)));
  for (const pid_t parent = getppid(); getppid() == parent; std::this_thread::sleep_for(milliseconds{50})) skip.step();
  return 0;
}
