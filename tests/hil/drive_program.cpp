// A program that drives both wheels of the foreign nodes for ever, and is killed by a test: drive_program INTERFACE.
// It says "driving" on stdout when they turn; it ends with 1 if the drive has an error.
#include "tests/hil/drive_config.hpp"

#include <poll.h>

#include <cstdio>

using namespace hogline;
using namespace hogline::hw;

namespace {

int drive_for_ever(SocketCanBus& bus, TwoWheelDrive& drive) {
  bool told = false;
  for (;; poll(nullptr, 0, 5)) {
    const Stamp now = std::chrono::steady_clock::now();
    const DriveState state = drive.state();
    if (state.error) {
      std::printf("%s: %s\n", state.error->device.c_str(), state.error->what.c_str());
      return 1;
    }
    if (state.phase == DrivePhase::ready) drive.enable();
    if (state.phase == DrivePhase::enabled) drive.command({10.0, 10.0}, now);
    if (!told && state.measured.left_radps > 9.9 && state.measured.right_radps > 9.9) {
      told = true;
      std::puts("driving");
      std::fflush(stdout);
    }
    bus.step(now);
    drive.step(now);
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  TwoWheelDriveConfig config = hil::patient_drive_config();
  config.timing.command_age_limit = std::chrono::milliseconds{400};
  config.timing.rpdo_timeout = std::chrono::milliseconds{500};
  SocketCanBus bus(hil::wheels_bus_config(arguments[1]), std::chrono::steady_clock::now());
  TwoWheelDrive drive(bus, config);
  return drive_for_ever(bus, drive);
}
