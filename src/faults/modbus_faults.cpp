// What can happen between the program and the gripper and arm, and in them.
#include "src/faults/case_words.hpp"

namespace hogline::faults {
namespace {

using namespace std::chrono_literals;
using hw::sim::ModbusBytes;
using hw::sim::ModbusServerFaults;

constexpr Duration silence = 85ms;  // the silence limit, a poll period and a control period

void well(Site& s) { s.rink().modbus().set_faults({}); }

Action commits(ModbusServerFaults faults) {
  return [faults = std::move(faults)](Site& s) { s.rink().modbus().set_faults(faults); };
}

template <typename Change>
Action tampers(Change change) {
  return commits({.tamper = [change](const ModbusBytes&, ModbusBytes answer) {
    change(answer);
    return answer;
  }});
}

template <typename Change>
Action device(Change change) {
  return [change](Site& s) { s.rink().modbus().inject(change); };
}

void over_rtu(ThrowRequest& request) { request.rig.modbus.line.line = hw::ModbusRtu{.device = {}, .baud = 115200}; }

Case serial(Case c) {
  c.prepare = over_rtu;
  return c;
}

std::vector<Case> line_faults() {
  const Action dies = [](Site& s) { s.rink().modbus().stop(); };
  const Action lives = [](Site& s) { s.rink().modbus().restart(); };
  Case forgiven = stops("one answer damaged", "a wrong unit for 5 ms, TCP", {}, "",
                        tampers([](ModbusBytes& a) { a[6] ^= 0x40; }), well);
  forgiven.expect = Expect::goes_on;
  forgiven.lasts = 5ms;
  forgiven.prepare = [](ThrowRequest& request) { request.rig.modbus.reconnect_delay = 20ms; };
  return {
      stops("server dies", "connections reset, port closed", silence, "jaws: disconnected", dies, lives),
      with(stops("server dies", "the same, while the robot measures", silence, "jaws: disconnected", dies, lives),
           Strike::measuring),
      short_of(with(stops("server dies", "the same, before the release and too near the line to stop", silence,
                          "jaws: disconnected", dies, lives),
                    Strike::too_late),
               "in the last 1.3 m before the line the robot can neither stop nor open jaws that it can not reach. It "
               "brakes with the stone held, and carries it into the hog line."),
      stops("accepts but never answers", "TCP, requests are read", silence, "jaws: timeout", commits({.stalled = true}),
            well),
      stops("answers late", "each answer waits for the next request, TCP", silence, "jaws:", commits({.late = true}),
            well),
      stops("exception", "each answer is exception 4", silence, "jaws: device fault", commits({.exception = 4}), well),
      stops("wrong transaction", "TCP transaction number changed", silence, "jaws: protocol",
            tampers([](ModbusBytes& a) { a[1] ^= 0x01; }), well),
      stops("wrong unit", "another unit answers, TCP", silence, "jaws: protocol",
            tampers([](ModbusBytes& a) { a[6] ^= 0x40; }), well),
      stops("wrong function", "another function answers, TCP", silence, "jaws: protocol",
            tampers([](ModbusBytes& a) { a[7] = 3; }), well),
      stops("wrong length", "a byte count that is not the answer's, TCP", silence, "jaws: protocol",
            tampers([](ModbusBytes& a) { a[8] = static_cast<std::uint8_t>(a[8] + 2); }), well),
      stops("reset in mid-frame", "half an answer, then RST", silence, "jaws: disconnected",
            commits({.reset_mid_frame = true}), well),
      stops("half-open", "the server has forgotten the connection", silence, "jaws: timeout",
            commits({.half_open = true}), well),
      serial(stops("wrong CRC", "RTU", silence, "jaws: protocol", tampers([](ModbusBytes& a) { a.back() ^= 0x10; }),
                   well)),
      serial(stops("truncated answer", "its last byte is missing, RTU", silence, "jaws: timeout",
                   tampers([](ModbusBytes& a) { a.pop_back(); }), well)),
      serial(stops("noise", "two bytes before each answer, RTU", silence, "jaws: protocol", tampers([](ModbusBytes& a) {
                     a.insert(a.begin(), {0xFF, 0x00});
                   }),
                   well)),
      serial(stops("line echo", "the request comes back before the answer, RTU", silence, "jaws: protocol",
                   commits({.tamper =
                                [](const ModbusBytes& request, ModbusBytes answer) {
                                  answer.insert(answer.begin(), request.begin(), request.end());
                                  return answer;
                                }}),
                   well)),
      forgiven,
  };
}

std::vector<Case> device_faults() {
  return {
      stops("frozen registers", "input registers keep their values", silence, "spin belt: protocol",
            commits({.freeze_inputs = true}), well),
      stops("gripper fault", "jaws report fault 0A (under voltage)", 30ms, "jaws: device fault",
            device([](auto& jaws, auto&, auto&) { jaws.set_fault(0x0A); }),
            device([](auto& jaws, auto&, auto&) { jaws.set_fault(0); })),
      with(stops("stone lost after the grip", "the closed jaws slip off it", 30ms,
                 "jaws: device fault: closed jaws lost", device([](auto& jaws, auto&, auto&) { jaws.lose_stone(); }),
                 {}),
           Strike::full_speed, Expect::stops_without_stone),
      with(stops("jaws open by themselves", "the fingers give way, nobody having asked", 30ms,
                 "jaws: device fault: closed jaws lost", device([](auto& jaws, auto&, auto&) { jaws.give_way(); }), {}),
           Strike::full_speed, Expect::stops_without_stone),
      with(stops("jaws do not open", "they answer, and do not move, at the trial in the hack", 600ms,
                 "rehearsal: the jaws do not report", device([](auto& jaws, auto&, auto&) { jaws.jam(true); }),
                 device([](auto& jaws, auto&, auto&) { jaws.jam(false); })),
           Strike::rehearsing),
      with(stops("jaws do not close again", "they answer, and do not move, with the stone set down in the hack", 2100ms,
                 "rehearsal: the jaws do not grip", device([](auto& jaws, auto&, auto&) { jaws.jam(true); }), {}),
           Strike::set_down, Expect::stops_without_stone),
      with(stops(
               "server dies", "the same, with the stone set down in the hack", silence, "disconnected: the other end",
               [](Site& s) { s.rink().modbus().stop(); }, [](Site& s) { s.rink().modbus().restart(); }),
           Strike::set_down, Expect::stops_without_stone),
      stops("jaws lose their activation", "power fails; activation would open them with the stone held", 30ms,
            "jaws: device fault: the jaws lost their activation",
            device([](auto& jaws, auto&, auto&) { jaws.cut_power(); }), {}),
      stops("spin belt fault", "the belt reports a fault", 30ms, "spin belt: device fault",
            device([](auto&, auto& belt, auto&) { belt.set_fault(1); }),
            device([](auto&, auto& belt, auto&) { belt.set_fault(0); })),
      stops("spin belt restarts", "its supply fails for a moment", 30ms, "spin belt: protocol",
            device([](auto&, auto& belt, auto&) { belt.power_cycle(); }), [](Site&) {}),
      with(stops("folding arm fault", "the arm reports a fault while the robot turns", 60ms,
                 "folding arm: device fault", device([](auto&, auto&, auto& arm) { arm.set_fault(1); }),
                 device([](auto&, auto&, auto& arm) { arm.set_fault(0); })),
           Strike::aligning),
      with(stops(
               "server dies at the release", "in the period after the order to open", silence, "jaws: disconnected",
               [](Site& s) { s.rink().modbus().stop(); }, [](Site& s) { s.rink().modbus().restart(); }),
           Strike::released, Expect::brakes_after),
  };
}

}  // namespace

std::vector<Case> modbus_faults() {
  std::vector<Case> all = line_faults();
  const std::vector<Case> rest = device_faults();
  all.insert(all.end(), rest.begin(), rest.end());
  return all;
}

}  // namespace hogline::faults
