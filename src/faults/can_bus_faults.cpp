// What can happen to the bus itself, and who else may talk on it.
#include "src/faults/case_words.hpp"

namespace hogline::faults {
namespace {

using namespace std::chrono_literals;
using hw::CanFrame;

hw::sim::VirtualCanBus& bus(Site& s) { return s.rink().bus(); }
void quiet(Site& s) { s.each_ms = {}; }
void clean(Site& s) {
  bus(s).set_faults(0.0, 0.0, 0.0);
  bus(s).set_reordering(0.0);
}
void all_pass(Site& s) { bus(s).set_filter({}); }
void adapter_back(Site& s) { bus(s).set_endpoint_up(s.rink().can(), true); }

std::vector<Case> outages() {
  const Action off = [](Site& s) { bus(s).set_up(false); };
  const Action back = [](Site& s) { bus(s).set_up(true); };
  return {
      stops("bus-off and return", "nothing passes for anybody", 10ms, "CAN bus: disconnected", off, back),
      with(stops("bus-off and return", "the same, while the robot turns", 10ms, "CAN bus: disconnected", off, back),
           Strike::aligning),
      stops(
          "link down and up", "the program's adapter is down for 0.1 s, up while the robot brakes", 10ms,
          "CAN bus: disconnected",
          [](Site& s) {
            bus(s).set_endpoint_up(s.rink().can(), false);
            s.each_ms = [&s, ms = 0]() mutable {
              if (++ms == 100) adapter_back(s);
            };
          },
          [](Site& s) {
            quiet(s);
            adapter_back(s);
          }),
      stops(
          "adapter unplugged and created again", "the program's adapter is gone until the robot stands", 10ms,
          "CAN bus: disconnected", [](Site& s) { bus(s).set_endpoint_up(s.rink().can(), false); }, adapter_back),
      stops(
          "flapping link", "the program's adapter is down 20 ms of each 40 ms", 25ms, "CAN bus: disconnected",
          [](Site& s) {
            s.each_ms = [&s, ms = 0]() mutable { bus(s).set_endpoint_up(s.rink().can(), (++ms / 20) % 2 == 1); };
          },
          [](Site& s) {
            quiet(s);
            adapter_back(s);
          }),
      stops(
          "error passive", "the program's controller counts errors", 10ms, "CAN bus: disconnected: error passive",
          [](Site& s) { bus(s).set_error_passive(s.rink().can(), true); },
          [](Site& s) { bus(s).set_error_passive(s.rink().can(), false); }),
      stops(
          "ENOBUFS and stale queue", "nobody acknowledges: commands wait in the controller, and leave later", 35ms,
          "timeout: no feedback", [](Site& s) { bus(s).set_stuck(true); }, [](Site& s) { bus(s).set_stuck(false); }),
  };
}

std::vector<Case> strangers() {
  return {
      stops(
          "babbling node", "a stranger fills the bus with 001", 35ms, "timeout: no feedback",
          [](Site& s) {
            s.each_ms = [&s] {
              while (s.stranger.send({.id = 0x001, .length = 8, .data = {}}) == hw::CanSendResult::sent) continue;
            };
          },
          quiet),
      stops(
          "two masters: NMT", "a stranger stops node 1", 15ms, "CAN bus: protocol: another master",
          [](Site& s) {
            s.stranger.send({.id = 0x000, .length = 2, .data = {0x02, 1}});
          },
          [](Site&) {}),
      stops(
          "two masters: set-point", "a stranger sends node 1 an RPDO: enable, full speed", 15ms,
          "CAN bus: protocol: another master",
          [](Site& s) {
            s.stranger.send({.id = 0x201, .length = 6, .data = {0x0F, 0x00, 0xFF, 0x7F, 0x00, 0x00}});
          },
          [](Site&) {}),
      stops(
          "SYNC doubled", "a stranger sends 080 too", 15ms, "CAN bus: protocol: another master",
          [](Site& s) {
            s.each_ms = [&s, ms = 0]() mutable {
              if (++ms % 5 == 0) s.stranger.send({.id = 0x080, .data = {}});
            };
          },
          quiet),
  };
}

std::vector<Case> frames() {
  return {
      goes_on(
          "one frame in a hundred lost", "loss 1 % until the end", {},
          [](Site& s) { bus(s).set_faults(0.01, 0.0, 0.0); }, clean),
      stops(
          "every second frame lost", "loss 50 %", 300ms, "timeout", [](Site& s) { bus(s).set_faults(0.5, 0.0, 0.0); },
          clean),
      goes_on(
          "one frame in a hundred doubled", "duplication 1 % until the end", {},
          [](Site& s) { bus(s).set_faults(0.0, 0.01, 0.0); }, clean),
      stops(
          "one frame in ten doubled", "duplication 10 %", 1s, "protocol: sends twice",
          [](Site& s) { bus(s).set_faults(0.0, 0.1, 0.0); }, clean),
      stops(
          "every frame doubled", "duplication 100 %", 45ms, "protocol: sends twice",
          [](Site& s) { bus(s).set_faults(0.0, 1.0, 0.0); }, clean),
      goes_on(
          "frames reordered", "each tenth frame overtakes its node's next one, until the end", {},
          [](Site& s) { bus(s).set_reordering(0.1); }, clean),
      stops(
          "frames corrupted", "a wrong bit in one frame of twenty, passed by the CRC", 200ms, "wheel (node",
          [](Site& s) { bus(s).set_faults(0.0, 0.0, 0.05); }, clean),
      goes_on(
          "one SYNC lost", "080 is away for one period", 5ms,
          [](Site& s) {
            bus(s).set_filter([left = 1](const CanFrame& f) mutable { return f.id != 0x080 || left-- <= 0; });
          },
          all_pass),
      stops(
          "SYNC lost", "no 080 passes", 35ms, "timeout: no feedback",
          [](Site& s) { bus(s).set_filter([](const CanFrame& f) { return f.id != 0x080; }); }, all_pass),
      goes_on("SYNC late", "one control period, with its SYNC, is 4 ms late", {}, [](Site& s) { s.loop_late = 4ms; },
              {}),
      stops(
          "our heartbeat lost", "no 77F passes: the drives' watchdog over us", 175ms, "EMCY 8130",
          [](Site& s) { bus(s).set_filter([](const CanFrame& f) { return f.id != 0x77F; }); }, all_pass),
      stops(
          "our commands lost", "no 201 passes: node 1's watchdog over its set-points", 60ms, "EMCY 8250",
          [](Site& s) { bus(s).set_filter([](const CanFrame& f) { return f.id != 0x201; }); }, all_pass),
  };
}

}  // namespace

std::vector<Case> can_bus_faults() {
  std::vector<Case> all;
  for (const auto& part : {outages(), strangers(), frames()}) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace hogline::faults
