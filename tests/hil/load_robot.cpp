#include "tests/hil/load_robot.hpp"

#include <chrono>
#include <fstream>

#include "src/steel/robot_bus.hpp"

namespace hogline::hil {

using namespace std::chrono_literals;

hw::SocketCanConfig patient_bus(const std::string& interface) {
  hw::SocketCanConfig config = robot_bus_config(interface, load_nodes, 127);
  config.confirm_deadline = 2s;
  return config;
}

long frames_on(const std::string& interface) {
  std::ifstream file("/sys/class/net/" + interface + "/statistics/tx_packets");
  long count = 0;
  file >> count;
  return count;
}

bool both(const hw::TwoWheelDrive& wheels, const hw::TwoAxisHead& head, hw::DrivePhase phase) {
  return wheels.state().phase == phase && head.state().phase == phase;
}

std::string why(const hw::TwoWheelDrive& wheels, const hw::TwoAxisHead& head) {
  for (const auto& error : {wheels.state().error, head.state().error})
    if (error) return error->device + ": " + error->what;
  return "no error";
}

}  // namespace hogline::hil
