#include "tests/hw/canopen/can_faults.hpp"

#include <cctype>
#include <limits>

namespace hogline::hw::test {
namespace {

using Left = CanFault::Left;
using Kind = DeviceErrorKind;

sim::DeviceFaults& left_faults(DriveBench& bench) { return bench.left.communication().faults; }

void nothing(DriveBench&) {}

// Nothing may be left of what an injection does each millisecond.
void quiet(DriveBench& bench) { bench.on_tick = nullptr; }

// ---- nodes ----

const std::vector<CanFault> node_faults{
    {"heartbeat stops, the rest lives", [](DriveBench& b) { left_faults(b).heartbeat_stopped = true; },
     [](DriveBench& b) { left_faults(b).heartbeat_stopped = false; }, 160ms, Kind::timeout, "heartbeat"},
    {"TPDOs stop with a live heartbeat", [](DriveBench& b) { left_faults(b).tpdos_stopped = true; },
     [](DriveBench& b) { left_faults(b).tpdos_stopped = false; }, 35ms, Kind::timeout, "feedback"},
    {"TPDOs repeat old contents", [](DriveBench& b) { left_faults(b).tpdos_frozen = true; },
     [](DriveBench& b) { left_faults(b).tpdos_frozen = false; }, 60ms, Kind::implausible, "encoder"},
    {"TPDOs of wrong length", [](DriveBench& b) { left_faults(b).tpdos_short = true; },
     [](DriveBench& b) { left_faults(b).tpdos_short = false; }, 15ms, Kind::protocol, "wrong length"},
    {"one wheel lost: the node dies, its holding brake closes",
     [](DriveBench& b) { b.left.kill(sim::AxisPower::braked); }, [](DriveBench& b) { b.left.power_cycle(); }, 35ms,
     Kind::timeout, "feedback"},
    {"one wheel lost: the node dies, its axis coasts", [](DriveBench& b) { b.left.kill(sim::AxisPower::unpowered); },
     [](DriveBench& b) { b.left.power_cycle(); }, 35ms, Kind::timeout, "feedback", Left::lost},
    {"unexpected boot-up: the drive's supply fails for a moment", [](DriveBench& b) { b.left.power_cycle(); }, nothing,
     35ms, Kind::device_fault, "unexpected boot-up", Left::lost},
    {"another node with the same id is plugged in",
     [](DriveBench& b) {
       b.intruder = std::make_unique<sim::Cia402DriveDevice>(b.bus.make_endpoint(), device_config(1));
     },
     [](DriveBench& b) { b.intruder->kill(sim::AxisPower::unpowered); }, 30ms, Kind::device_fault,
     "another node has its id"},
    {"two nodes answer under one id",
     [](DriveBench& b) {
       b.on_frame = [&b](const StampedCanFrame& seen) {
         if (seen.frame.id == 0x181 && !b.echoing) b.echo = seen.frame;
       };
       b.on_tick = [&b] {
         b.echoing = b.echo.has_value();
         if (b.echo) b.stray.send(*std::exchange(b.echo, std::nullopt));
       };
     },
     [](DriveBench& b) {
       b.on_frame = nullptr;
       quiet(b);
     },
     60ms, Kind::protocol, "two nodes with this id"},
};

// ---- drives ----

const std::vector<CanFault> drive_faults{
    {"fault of the drive", [](DriveBench& b) { b.left.raise_fault(0x2310); }, nothing, 15ms, Kind::device_fault,
     "EMCY 2310 (current)"},
    {"EMCY without a change of state", [](DriveBench& b) { b.left.communication().emergency(0x8120, 0x10); }, nothing,
     15ms, Kind::device_fault, "EMCY 8120 (CAN error passive)"},
    {"flood of EMCY",
     [](DriveBench& b) {
       b.on_tick = [&b] {
         for (int i = 0; i < 7; ++i) b.left.communication().emergency(0x8110, 0x10);
       };
     },
     quiet, 15ms, Kind::device_fault, "EMCY 8110", Left::brakes, 1e6},
    {"statusword stuck at enabled while the speed diverges",
     [](DriveBench& b) {
       b.left.faults.statusword_stuck = true;
       b.left.faults.speed_stuck = true;
       b.set_point = WheelSpeeds{15.0, 15.0};
     },
     [](DriveBench& b) { b.left.faults = {}; }, 125ms, Kind::implausible, "does not follow", Left::lost},
    {"quick stop ignored",
     [](DriveBench& b) {
       b.left.faults.quick_stop_ignored = true;
       b.drive.quick_stop();
     },
     [](DriveBench& b) { b.left.faults = {}; }, 65ms, Kind::refused, "transition 11"},
    {"fault of the drive during its quick stop",
     [](DriveBench& b) {
       b.drive.quick_stop();
       b.run(100ms);
       b.left.raise_fault(0x7500);
     },
     nothing, 115ms, Kind::device_fault, "EMCY 7500"},
    {"the drive leaves the mode", [](DriveBench& b) { b.left.communication().objects().set(0x6060, 0, 3); }, nothing,
     15ms, Kind::device_fault, "mode 3"},
    {"encoder jumps by two motor revolutions", [](DriveBench& b) { b.left.axis().slip_encoder(2.0); }, nothing, 15ms,
     Kind::implausible, ""},
    {"encoder changes its sign", [](DriveBench& b) { b.left.faults.position_scale = -1.0; },
     [](DriveBench& b) { b.left.faults.position_scale = 1.0; }, 30ms, Kind::implausible, "encoder"},
    {"encoder changes its scale by half", [](DriveBench& b) { b.left.faults.position_scale = 0.5; },
     [](DriveBench& b) { b.left.faults.position_scale = 1.0; }, 50ms, Kind::implausible, "encoder"},
};

// ---- bus ----

const std::vector<CanFault> bus_faults{
    {"bus-off and return", [](DriveBench& b) { b.bus.set_up(false); }, [](DriveBench& b) { b.bus.set_up(true); }, 10ms,
     Kind::disconnected, "bus off"},
    {"adapter unplugged and created again", [](DriveBench& b) { b.bus.set_endpoint_up(b.master, false); },
     [](DriveBench& b) { b.bus.set_endpoint_up(b.master, true); }, 10ms, Kind::disconnected, "adapter gone"},
    {"flapping link",
     [](DriveBench& b) {
       b.on_tick = [&b, ms = 0]() mutable { b.bus.set_endpoint_up(b.master, (++ms / 20) % 2 == 1); };
     },
     [](DriveBench& b) {
       quiet(b);
       b.bus.set_endpoint_up(b.master, true);
     },
     15ms, Kind::disconnected, "link down"},
    {"error passive", [](DriveBench& b) { b.bus.set_error_passive(b.master, true); },
     [](DriveBench& b) { b.bus.set_error_passive(b.master, false); }, 10ms, Kind::disconnected, "error passive"},
    {"nobody acknowledges", [](DriveBench& b) { b.bus.set_stuck(true); }, [](DriveBench& b) { b.bus.set_stuck(false); },
     35ms, Kind::timeout, "feedback"},
    {"babbling node takes the whole bus",
     [](DriveBench& b) {
       b.on_tick = [&b] {
         while (b.stray.send({.id = 0x001, .length = 8, .data = {}}) == CanSendResult::sent) continue;
       };
     },
     quiet, 35ms, Kind::timeout, "feedback", Left::brakes, 1e6},
    {"node babbles more than a step can read",
     [](DriveBench& b) {
       b.on_tick = [&b] {
         for (int i = 0; i < 200; ++i) {
           b.stray.send({.id = 0x7F0, .length = 0, .data = {}});
           b.bus.deliver();
         }
       };
     },
     quiet, 10ms, Kind::protocol, "flooded"},
    {"every second frame is lost", [](DriveBench& b) { b.bus.set_faults(0.5, 0.0, 0.0); },
     [](DriveBench& b) { b.bus.set_faults(0.0, 0.0, 0.0); }, 300ms, Kind::timeout, ""},
    {"every frame arrives twice", [](DriveBench& b) { b.bus.set_faults(0.0, 1.0, 0.0); },
     [](DriveBench& b) { b.bus.set_faults(0.0, 0.0, 0.0); }, 60ms, Kind::protocol, "second SYNC"},
    {"SYNC lost", [](DriveBench& b) { b.bus.set_filter([](const CanFrame& frame) { return frame.id != 0x080; }); },
     [](DriveBench& b) { b.bus.set_filter({}); }, 35ms, Kind::timeout, "feedback"},
    {"SYNC late by seven periods",
     [](DriveBench& b) {
       b.bus.set_filter(
           [left = 7](const CanFrame& frame) mutable { return frame.id != 0x080 || left == 0 || --left < 0; });
     },
     [](DriveBench& b) { b.bus.set_filter({}); }, 35ms, Kind::timeout, "feedback"},
    {"SYNC doubled by somebody else",
     [](DriveBench& b) {
       b.on_frame = [&b](const StampedCanFrame& seen) {
         if (seen.frame.id == 0x080 && !std::exchange(b.echoing, !b.echoing)) b.stray.send({.id = 0x080, .data = {}});
       };
     },
     [](DriveBench& b) { b.on_frame = nullptr; }, 15ms, Kind::protocol, "another master"},
    {"our heartbeat lost", [](DriveBench& b) { b.bus.set_filter([](const CanFrame& f) { return f.id != 0x77F; }); },
     [](DriveBench& b) { b.bus.set_filter({}); }, 160ms, Kind::device_fault, "8130"},
    {"two masters: somebody stops the node by NMT",
     [](DriveBench& b) {
       b.stray.send({.id = 0x000, .length = 2, .data = {0x02, 1}});
     },
     nothing, 15ms, Kind::protocol, "another master"},
    {"two masters: somebody commands the wheel",
     [](DriveBench& b) {
       b.stray.send({.id = 0x201, .length = 6, .data = {0x0F, 0x00, 0xFF, 0x7F}});
     },
     nothing, 15ms, Kind::protocol, "another master"},
};

// ---- the program that commands ----

const std::vector<CanFault> host_faults{
    {"no new set-points", [](DriveBench& b) { b.set_point.reset(); }, nothing, 25ms, Kind::timeout, "no new set-point"},
    {"control thread late by 30 ms",
     [](DriveBench& b) {
       b.loop_stalled = true;
       b.run(30ms);
       b.loop_stalled = false;
     },
     nothing, 35ms, Kind::timeout, "control loop"},
    {"set-point is not a number",
     [](DriveBench& b) {
       b.set_point = WheelSpeeds{std::numeric_limits<double>::quiet_NaN(), 1.0};
     },
     nothing, 10ms, Kind::implausible, "not finite"},
    {"set-point beyond the limit",
     [](DriveBench& b) {
       b.set_point = WheelSpeeds{31.0, 31.0};
     },
     nothing, 10ms, Kind::implausible, "beyond the limit"},
};

}  // namespace

void PrintTo(const CanFault& fault, std::ostream* out) { *out << fault.description; }

const std::vector<CanFault>& can_faults() {
  static const std::vector<CanFault> all = [] {
    std::vector<CanFault> faults;
    for (const auto* part : {&node_faults, &drive_faults, &bus_faults, &host_faults}) {
      faults.insert(faults.end(), part->begin(), part->end());
    }
    return faults;
  }();
  return all;
}

std::string test_name(const char* description) {
  std::string name;
  for (const char* c = description; *c; ++c) name += std::isalnum(static_cast<unsigned char>(*c)) ? *c : '_';
  return name;
}

}  // namespace hogline::hw::test
