// What a drive node can do wrong: its boot, its frames, its axis.
#include <cstring>

#include "src/faults/case_words.hpp"

namespace hogline::faults {
namespace {

using namespace std::chrono_literals;
using hw::CanFrame;
using hw::sim::AxisPower;

hw::sim::DeviceFaults& talk(Site& s) { return s.left().communication().faults; }
void talk_well(Site& s) { talk(s) = {}; }
void behave(Site& s) { s.left().faults = {}; }
void straight(Site& s) { s.rink().bus().set_tamper({}); }
void supply_back(Site& s) { s.left().power_cycle(); }

constexpr const char* node1 = "left wheel (node 1)";

constexpr const char* rolls =
    "the drive has no torque and its brake stays open, so its axis rolls: the other wheel brakes and the body turns "
    "about "
    "it until friction stops it. The controller can do no more; the wheels need brakes that close without power.";
constexpr const char* drives_on =
    "a drive that neither follows nor obeys is stopped only by what takes its power away. The program tells it so and "
    "stops the other wheel; the body turns until friction stops it. An e-stop circuit must cut the supply.";

std::string of_left(const char* what) { return std::string(node1) + ": " + what; }

// The answer to reading 1018:02, or to the first write of an SDO, changed on the wire.
void wrong_product(CanFrame& f) {
  if (f.id == 0x581 && f.data[0] == 0x43 && f.data[1] == 0x18 && f.data[2] == 0x10 && f.data[3] == 2) f.data[4] ^= 0xFF;
}
void refuse_writes(CanFrame& f) {
  if (f.id != 0x581 || f.data[0] != 0x60) return;
  f.data[0] = 0x80;
  f.data[4] = 0x00;
  f.data[5] = 0x00;
  f.data[6] = 0x00;
  f.data[7] = 0x08;
}

std::vector<Case> boot_faults() {
  const auto boot = [](const char* name, const char* injected, Duration deadline, std::string says, Action inject,
                       Action heal) {
    return Case{.name = name,
                .injected = injected,
                .strike = Strike::power_on,
                .expect = Expect::does_not_start,
                .deadline = deadline,
                .says = std::move(says),
                .inject = std::move(inject),
                .heal = std::move(heal)};
  };
  return {
      boot(
          "node never boots", "node 1 has no supply", 5200ms, of_left("timeout"),
          [](Site& s) { s.left().kill(AxisPower::unpowered); }, supply_back),
      boot(
          "node does not come back from its reset", "node 1 stays silent after NMT reset", 10500ms, of_left("timeout"),
          [](Site& s) { talk(s).never_boots = true; },
          [](Site& s) {
            talk_well(s);
            supply_back(s);
          }),
      boot(
          "wrong identity", "the answer to 1018:02 names another product", 1000ms, of_left(""),
          [](Site& s) { s.rink().bus().set_tamper(wrong_product); }, straight),
      boot(
          "SDO abort", "each SDO write of node 1 is answered 80 .. 08000000", 2000ms, of_left("refused"),
          [](Site& s) { s.rink().bus().set_tamper(refuse_writes); }, straight),
      boot(
          "SDO timeout", "node 1 answers no SDO", 5200ms, of_left(""), [](Site& s) { talk(s).sdo_silent = true; },
          talk_well),
      boot(
          "SDO toggle", "node 1's segments do not alternate their toggle bit", 2000ms, of_left("protocol"),
          [](Site& s) { talk(s).sdo_toggle_stuck = true; }, talk_well),
      boot(
          "SDO wrong echo", "node 1's answers name another sub-index", 2000ms, of_left("protocol"),
          [](Site& s) { talk(s).sdo_wrong_echo = true; }, talk_well),
      boot(
          "SDO write forgotten", "node 1 confirms the write of 6085 and forgets it", 2000ms, of_left(""),
          [](Site& s) { talk(s).sdo_ignores = 0x608500; }, talk_well),
      boot(
          "mode never confirms", "node 1's 6061 stays 0", 5600ms, of_left("refused: 6061 never confirms"),
          [](Site& s) { s.left().faults.mode_never_confirmed = true; }, behave),
  };
}

std::vector<Case> talking_faults() {
  return {
      stops(
          "heartbeat stops", "node 1 sends no 701, all else lives", 155ms, of_left("timeout: no heartbeat"),
          [](Site& s) { talk(s).heartbeat_stopped = true; }, talk_well),
      with(stops(
               "heartbeat stops", "the same, while the robot turns", 155ms, of_left("timeout: no heartbeat"),
               [](Site& s) { talk(s).heartbeat_stopped = true; }, talk_well),
           Strike::aligning),
      short_of(stops("unexpected boot-up", "node 1's supply fails for a moment", 35ms,
                     of_left("device fault: unexpected boot-up"), supply_back, [](Site&) {}),
               rolls),
      stops(
          "PDO of wrong length", "node 1's TPDOs are a byte short", 15ms, of_left("protocol: TPDO1 of wrong length"),
          [](Site& s) { talk(s).tpdos_short = true; }, talk_well),
      stops(
          "TPDOs stop", "node 1 sends no TPDO, its heartbeat lives", 35ms, of_left("timeout: no feedback"),
          [](Site& s) { talk(s).tpdos_stopped = true; }, talk_well),
      stops(
          "frozen TPDO with live heartbeat", "node 1's TPDOs repeat old contents", 60ms,
          of_left("implausible: encoder"), [](Site& s) { talk(s).tpdos_frozen = true; }, talk_well),
      goes_on(
          "one TPDO lost", "node 1's TPDOs are away for one period", 5ms, [](Site& s) { talk(s).tpdos_stopped = true; },
          talk_well),
      stops(
          "duplicate id", "a second device boots as node 1", 50ms, of_left("device fault: unexpected boot-up"),
          [](Site& s) { s.stranger.send({.id = 0x701, .length = 1, .data = {0x00}}); }, [](Site&) {}),
      stops(
          "two nodes answer under one id", "a second 181 after each 181", 45ms, of_left("protocol: sends twice"),
          [](Site& s) {
            s.each_ms = [&s, ms = 0]() mutable {
              if (++ms % 5 == 0) s.stranger.send({.id = 0x181, .length = 7, .data = {0x37, 0x12, 0, 0, 0, 0, 9}});
            };
          },
          [](Site& s) { s.each_ms = {}; }),
      goes_on(
          "RTR and 29-bit frames with our ids", "remote 181 and extended 00000181 at 1 kHz", 500ms,
          [](Site& s) {
            s.each_ms = [&s] {
              s.stranger.send({.id = 0x181, .remote = true, .length = 7, .data = {}});
              s.stranger.send({.id = 0x181, .extended = true, .length = 8, .data = {}});
            };
          },
          [](Site& s) { s.each_ms = {}; }),
  };
}

std::vector<Case> axis_faults() {
  std::vector<Case> cases{
      short_of(with(stops(
                        "statusword stuck at enabled, speed diverges",
                        "node 1 keeps 6041 and its speed while the robot speeds up", 1s,
                        of_left("implausible: speed does not follow"),
                        [](Site& s) {
                          s.left().faults.statusword_stuck = true;
                          s.left().faults.speed_stuck = true;
                        },
                        behave),
                    Strike::speeding_up),
               drives_on),
      stops(
          "EMCY flood", "node 1 sends seven EMCY 8110 a millisecond", 15ms, of_left("device fault: EMCY 8110"),
          [](Site& s) {
            s.each_ms = [&s] {
              for (int i = 0; i < 7; ++i) s.left().communication().emergency(0x8110, 0x10);
            };
          },
          [](Site& s) { s.each_ms = {}; }),
      stops(
          "drive fault", "node 1: EMCY 2310 (current), fault reaction", 15ms, of_left("device fault: EMCY 2310"),
          [](Site& s) { s.left().raise_fault(0x2310); }, [](Site&) {}),
      with(stops(
               "fault during quick stop", "node 1: EMCY 7500 while it brakes", 15ms, of_left("device fault: EMCY 7500"),
               [](Site& s) { s.left().raise_fault(0x7500); }, [](Site&) {}),
           Strike::braking),
      stops(
          "one wheel lost, its brake closes", "node 1 dies, holding brake", 35ms, of_left("timeout: no feedback"),
          [](Site& s) { s.left().kill(AxisPower::braked); }, supply_back),
      short_of(stops(
                   "one wheel lost, its axis coasts", "node 1 dies without power", 35ms,
                   of_left("timeout: no feedback"), [](Site& s) { s.left().kill(AxisPower::unpowered); }, supply_back),
               rolls),
      stops(
          "encoder jumps", "node 1's 6064 jumps by two motor turns", 15ms, of_left("implausible"),
          [](Site& s) { s.left().axis().slip_encoder(2.0); }, [](Site&) {}),
      stops(
          "encoder changes its sign", "node 1's 6064 counts backwards", 30ms, of_left("implausible"),
          [](Site& s) { s.left().faults.position_scale = -1.0; }, behave),
      stops(
          "encoder changes its scale", "node 1's 6064 halves", 60ms, of_left("implausible: encoder"),
          [](Site& s) { s.left().faults.position_scale = 0.5; }, behave),
  };
  Case ignored = stops("quick stop ignored", "a gyro fault at 2.5 m/s; node 1 does not obey controlword bit 2", 60ms,
                       of_left("refused: transition 11"), {}, [](Site& s) {
                         behave(s);
                         s.rink().gyro().set_silent(false);
                       });
  ignored.inject = [](Site& s) {
    s.left().faults.quick_stop_ignored = true;
    s.rink().gyro().set_silent(true);
  };
  cases.push_back(ignored);

  Case wrap = goes_on("position counter wraps", "both 6064 pass 2^31 in the run", {}, [](Site& s) {
    constexpr double turns = 2147483648.0 / 65536.0;
    s.left().axis().slip_encoder(turns - 150.0);
    s.right().axis().slip_encoder(-turns + 150.0);
  });
  wrap.strike = Strike::power_on;
  cases.push_back(wrap);
  return cases;
}

}  // namespace

std::vector<Case> can_node_faults() {
  std::vector<Case> all;
  for (const auto& part : {boot_faults(), talking_faults(), axis_faults()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace hogline::faults
