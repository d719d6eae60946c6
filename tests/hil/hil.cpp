#include "tests/hil/hil.hpp"

#include <net/if.h>
#include <poll.h>

#include "tests/hil/process.hpp"

namespace hogline::hil {

Stamp now() { return std::chrono::steady_clock::now(); }

bool wait_until(const std::function<bool()>& done, Duration limit, std::chrono::milliseconds rhythm) {
  for (const Stamp end = now() + limit; now() < end; poll(nullptr, 0, static_cast<int>(rhythm.count()))) {
    if (done()) return true;
  }
  return done();
}

std::vector<hw::StampedCanFrame> period(hw::SocketCanBus& bus) {
  std::vector<hw::StampedCanFrame> frames;
  bus.step(now());
  while (auto received = bus.receive()) frames.push_back(*received);
  return frames;
}

bool run_until(hw::SocketCanBus& bus, const std::function<bool()>& done, Duration limit) {
  return wait_until(
      [&] {
        period(bus);
        return done();
      },
      limit);
}

std::vector<hw::StampedCanFrame> receive(hw::SocketCanBus& bus, std::size_t count, Duration limit) {
  std::vector<hw::StampedCanFrame> frames;
  wait_until(
      [&] {
        const auto more = period(bus);
        frames.insert(frames.end(), more.begin(), more.end());
        return frames.size() >= count;
      },
      limit);
  return frames;
}

void VcanTest::SetUp() { run("ip link add " + name_ + " type vcan && ip link set " + name_ + " up"); }

void VcanTest::TearDown() {
  if (if_nametoindex(name_.c_str()) != 0) run("ip link del " + name_);
}

hw::SocketCanBus VcanTest::running_bus(hw::SocketCanConfig config) const {
  config.interface = name_;
  hw::SocketCanBus bus(std::move(config), now());
  EXPECT_TRUE(run_until(bus, [&] { return bus.up(); }));
  return bus;
}

}  // namespace hogline::hil
