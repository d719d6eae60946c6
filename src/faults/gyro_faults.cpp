// What can happen to the gyro and its line.
#include <numbers>

#include "src/faults/case_words.hpp"

namespace hogline::faults {
namespace {

using namespace std::chrono_literals;
using hw::sim::GyroDevice;

constexpr double deg = std::numbers::pi / 180.0;
constexpr Duration silence = 45ms;  // the silence limit, a reading and a control period

GyroDevice& gyro(Site& s) { return s.rink().gyro(); }

Action biased(double degps) {
  return [degps](Site& s) { gyro(s).add_bias(degps * deg); };
}

Case at_line_rate(const char* name, const char* injected, double factor) {
  Case c = goes_on(name, injected, {}, [](Site&) {});
  c.strike = Strike::power_on;
  c.prepare = [factor](ThrowRequest& request) { request.scenario.gyro.line_rate_hz *= factor; };
  return c;
}

void enter_wrong_mode(Site& s) {
  gyro(s).set_mode(GyroDevice::Mode::incremental_angle);
  gyro(s).set_deaf(true);
}
void hear_again(Site& s) { gyro(s).set_deaf(false); }

Case wrong_mode(const char* injected) {
  return stops("wrong mode", injected, 1s, "gyro", enter_wrong_mode, hear_again);
}

Case over_words(Case c) {
  c.prepare = [](ThrowRequest& request) { request.rig.gyro.variant = hw::Dsp3000Variant::binary; };
  return c;
}

}  // namespace

std::vector<Case> gyro_faults() {
  const Action silent = [](Site& s) { gyro(s).set_silent(true); };
  const Action speaks = [](Site& s) { gyro(s).set_silent(false); };
  return {
      stops("silence", "no more readings", silence, "gyro: timeout", silent, speaks),
      with(stops("silence", "the same, while the robot measures", silence, "gyro: timeout", silent, speaks),
           Strike::measuring),
      with(stops("silence", "the same, while the robot turns", silence, "gyro: timeout", silent, speaks),
           Strike::aligning),
      goes_on("one reading missing", "silent for 10 ms", 10ms, silent, speaks),
      stops(
          "invalid bit", "each reading is marked 0", silence, "gyro", [](Site& s) { gyro(s).set_valid(false); },
          [](Site& s) { gyro(s).set_valid(true); }),
      stops(
          "garbled", "bits of each line are flipped", silence, "gyro", [](Site& s) { gyro(s).set_garbled(true); },
          [](Site& s) { gyro(s).set_garbled(false); }),
      stops(
          "stuck", "the last reading again and again", 140ms, "gyro: implausible",
          [](Site& s) { gyro(s).set_stuck(true); }, [](Site& s) { gyro(s).set_stuck(false); }),
      with(stops("bias step", "0.5 deg/s while the robot measures", 3s, "gyro", biased(0.5), biased(-0.5)),
           Strike::measuring),
      stops("bias step", "18 deg/s in the run", 200ms, "gyro and wheels disagree", biased(18.0), biased(-18.0)),
      stops("bias step", "2 deg/s in the run", 1s, "the sheet's direction and the gyro disagree", biased(2.0),
            biased(-2.0)),
      stops("overrange", "600 deg/s, marked valid", silence, "gyro: implausible", biased(600.0), biased(-600.0)),
      with(wrong_mode("incremental angle instead of rate, while the robot turns"), Strike::aligning),
      wrong_mode("incremental angle instead of rate, in the run"),
      over_words(wrong_mode("incremental angle instead of rate, binary variant")),
      goes_on(
          "burst after a stall", "held for 10 ms, then all at once", 10ms, [](Site& s) { gyro(s).set_held(true); },
          [](Site& s) { gyro(s).set_held(false); }),
      stops(
          "burst after a long stall", "held for 0.3 s, then all at once", silence, "gyro: timeout",
          [](Site& s) { gyro(s).set_held(true); }, [](Site& s) { gyro(s).set_held(false); }),
      stops(
          "tty renamed", "the serial device is gone, and comes back", 15ms, "gyro: disconnected",
          [](Site& s) { s.robot.gyro_line().unplug(true); }, [](Site& s) { s.robot.gyro_line().unplug(false); }),
      at_line_rate("3 % slower", "97 readings a second from power-on", 0.97),
      at_line_rate("3 % faster", "103 readings a second from power-on", 1.03),
  };
}

}  // namespace hogline::faults
