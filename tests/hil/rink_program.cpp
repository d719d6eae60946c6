// The simulated rink as a program of its own, in real time behind this machine's own lines: rink_program INTERFACE.
// Its drives are on that CAN interface, its gripper and arm serve Modbus on a TCP port of the loopback interface, its
// gyro is a serial line. Says "modbus PORT gyro PATH" on stdout, and runs until it is killed.
#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "hw/socketcan/socket_can_bus.hpp"
#include "src/config/embedded.hpp"
#include "src/config/scenario.hpp"
#include "src/throwing/simulated_robot.hpp"

using namespace hogline;

namespace {

// A serial line whose other end another program opens by its path.
class SerialLine {
 public:
  SerialLine() {
    std::array<char, 128> path{};
    int other = -1;  // held open, so that the other program may come and go
    if (openpty(&descriptor_, &other, path.data(), nullptr, nullptr) != 0) return;
    termios settings{};
    tcgetattr(other, &settings);
    cfmakeraw(&settings);
    tcsetattr(other, TCSANOW, &settings);
    fcntl(descriptor_, F_SETFL, O_NONBLOCK);
    path_ = path.data();
  }
  const std::string& path() const { return path_; }
  std::string read() const {
    std::array<char, 256> bytes{};
    const auto got = ::read(descriptor_, bytes.data(), bytes.size());
    return {bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(got, 0))};
  }
  // What nobody reads is lost, as on a wire.
  void write(const std::string& bytes) const {
    if (::write(descriptor_, bytes.data(), bytes.size()) < 0) return;
  }

 private:
  int descriptor_ = -1;
  std::string path_;
};

void run(hw::sim::Rink& rink, hw::SocketCanBus& bus, const SerialLine& gyro) {
  for (Stamp last = std::chrono::steady_clock::now();; poll(nullptr, 0, 1)) {
    const Stamp now = std::chrono::steady_clock::now();
    bus.step(now);
    while (const auto received = bus.receive()) rink.can().send(received->frame);
    if (const std::string words = gyro.read(); !words.empty()) rink.gyro().write(words);
    rink.step(now - last);
    last = now;
    while (const auto sent = rink.can().receive()) static_cast<void>(bus.send(sent->frame));
    if (const std::string bytes = rink.read_gyro(); !bytes.empty()) gyro.write(bytes);
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const config::ThrowerRig rig = config::parse_thrower_rig(config::embedded_file("rigs/practice.yaml"), "practice rig");
  auto scenario = config::parse_scenario(config::embedded_file("scenarios/practice.yaml"), "practice", 1);
  scenario.belt.watchdog_s = scenario.arm.watchdog_s = 10.0;  // a test machine that stalls is no lost master
  SimulatedRobot robot(rig, scenario);
  hw::SocketCanBus bus({.interface = arguments[1]}, std::chrono::steady_clock::now());
  const SerialLine gyro;
  std::printf("modbus %d gyro %s\n", robot.rink().modbus_port(), gyro.path().c_str());
  std::fflush(stdout);
  run(robot.rink(), bus, gyro);
}
