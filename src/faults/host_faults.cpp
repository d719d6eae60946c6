// What can happen to the program, and to the robot as a whole.
#include <limits>

#include "src/faults/case_words.hpp"

namespace hogline::faults {
namespace {

using namespace std::chrono_literals;
using hw::sim::AxisPower;

void power_cut(Site& s) {
  s.left().kill(AxisPower::braked);
  s.right().kill(AxisPower::braked);
}
void power_back(Site& s) {
  s.left().power_cycle();
  s.right().power_cycle();
}

}  // namespace

std::vector<Case> host_faults() {
  const Action nothing = [](Site&) {};
  const Action late = [](Site& s) { s.loop_late = 30ms; };
  Case killed = stops(
      "program killed or hung", "the control loop does not run until the robot stands", 60ms, "on the bus: EMCY 8250",
      [](Site& s) { s.loop_dead = true; }, [](Site& s) { s.loop_dead = false; });
  return {
      goes_on("control thread late by 4 ms", "one period", {}, [](Site& s) { s.loop_late = 4ms; }),
      stops("control thread late by 30 ms", "one period", 40ms, "drive: timeout: the control loop did not run", late,
            nothing),
      with(stops("control thread late by 30 ms", "one period, while the robot turns", 40ms,
                 "drive: timeout: the control loop did not run", late, nothing),
           Strike::aligning),
      killed,
      stops(
          "set-point is not a number", "given to the drive behind the controller", 15ms, "drive: implausible",
          [](Site& s) {
            s.set_point = hw::WheelSpeeds{std::numeric_limits<double>::quiet_NaN(), 1.0};
          },
          nothing),
      stops(
          "set-point beyond the limit", "given to the drive behind the controller", 15ms, "drive: implausible",
          [](Site& s) {
            s.set_point = hw::WheelSpeeds{100.0, 100.0};
          },
          nothing),
      stops("e-stop pressed and released", "both drives lose their supply, brakes fall in; it comes back", 35ms,
            "left wheel (node 1): timeout", power_cut, power_back),
      with(stops("e-stop pressed and released", "the same, while the robot turns", 35ms, "left wheel (node 1): timeout",
                 power_cut, power_back),
           Strike::aligning),
      with(stops(
               "second fault during the reaction", "the bus goes down while the robot brakes for another fault", 10ms,
               "CAN bus: disconnected", [](Site& s) { s.rink().bus().set_up(false); },
               [](Site& s) { s.rink().bus().set_up(true); }),
           Strike::braking),
      with(stops(
               "second fault during the reaction", "the other wheel dies while the robot brakes", 35ms,
               "right wheel (node 2): timeout", [](Site& s) { s.right().kill(AxisPower::braked); },
               [](Site& s) { s.right().power_cycle(); }),
           Strike::braking),
      with(stops(
               "second fault during the reaction", "Modbus dies while the robot brakes", 85ms, "jaws: disconnected",
               [](Site& s) { s.rink().modbus().stop(); }, [](Site& s) { s.rink().modbus().restart(); }),
           Strike::braking),
  };
}

}  // namespace hogline::faults
