#include "src/doctor/drive_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "hw/canopen/cia402.hpp"
#include "hw/canopen/emergency.hpp"
#include "hw/canopen/sdo_client.hpp"
#include "src/doctor/bus_ear.hpp"

namespace hogline::doctor {
namespace {

using namespace std::chrono_literals;
using hw::ObjectAddress;
using hw::SdoResult;

constexpr Duration tick = 1ms;
constexpr Duration listening = 400ms;  // several heartbeats of any usual period
constexpr int tries = 4;
constexpr std::uint32_t drive_profile = 402;
constexpr std::uint32_t profile_position = 1U << 0U;  // bits of 6502
constexpr std::uint32_t cyclic_velocity = 1U << 8U;

constexpr ObjectAddress device_type{0x1000, 0};
constexpr ObjectAddress error_register{0x1001, 0};
constexpr ObjectAddress device_name{0x1008, 0};
constexpr ObjectAddress firmware{0x100A, 0};
constexpr ObjectAddress vendor_id{0x1018, 1};
constexpr ObjectAddress product_code{0x1018, 2};
constexpr ObjectAddress serial_number{0x1018, 4};
constexpr ObjectAddress error_code{0x603F, 0};
constexpr ObjectAddress statusword{0x6041, 0};
constexpr ObjectAddress mode_display{0x6061, 0};
constexpr ObjectAddress velocity{0x606C, 0};
constexpr ObjectAddress supported_modes{0x6502, 0};

// Everything that is sent goes through here: SDO uploads.
class Asking {
 public:
  Asking(Site& site, BusEar& ear) : site_(site), ear_(ear) {}

  void listen(Duration span) {
    for (const Stamp end = site_.now() + span; site_.now() < end;) turn(nullptr, 0);
  }

  /// The last answer of a few tries, and in `latency_s` how long it took.
  SdoResult read(std::uint8_t node, ObjectAddress address, Duration timeout) {
    SdoResult result;
    for (int i = 0; i < tries; ++i) {
      hw::SdoClient client(node, timeout);
      const Stamp asked = site_.now();
      client.start_upload(address, asked);
      auto answer = client.take_result();
      while (!answer) {
        turn(&client, node);
        client.step(site_.now());
        answer = client.take_result();
      }
      result = *answer;
      latency_s = seconds(site_.now() - asked);
      if (result.outcome != SdoResult::Outcome::timeout) break;
    }
    return result;
  }

  double latency_s = 0.0;

 private:
  void turn(hw::SdoClient* client, std::uint8_t node) {
    while (client != nullptr) {
      const auto frame = client->take_frame();
      if (!frame) break;
      site_.can().send(*frame);
    }
    site_.pass(tick);
    while (const auto received = site_.can().receive()) {
      ear_.on_frame(*received);
      if (client != nullptr && !received->frame.extended && received->frame.id == 0x580U + node) {
        client->on_frame(received->frame, site_.now());
      }
    }
  }

  Site& site_;
  BusEar& ear_;
};

// What one drive must be.
struct Expected {
  std::string name;
  std::uint8_t node = 0;
  std::uint32_t vendor_id = 0;
  std::uint32_t product_code = 0;
  std::uint32_t modes = 0;  // bits of 6502
  const char* mode_names = "";
  double radps_per_unit = 0.0;  // of 606C
  double standstill_radps = 0.0;
  Duration sdo_timeout{};
};

Expected expected(const hw::WheelConfig& w, const hw::TwoWheelDriveConfig& config) {
  const double turn_radps = 2.0 * std::numbers::pi / w.gear_ratio * w.direction;
  return {w.name,
          w.node,
          w.vendor_id,
          w.product_code,
          cyclic_velocity,
          "cyclic synchronous velocity",
          turn_radps / w.velocity_units_per_motor_rps,
          config.plausibility.standstill_radps,
          config.timing.sdo_timeout};
}

Expected expected(const hw::HeadAxisConfig& axis, const hw::TwoAxisHeadConfig& config) {
  const double turn_radps = 2.0 * std::numbers::pi / axis.gearing.gear_ratio * axis.gearing.direction;
  return {axis.identity.name,
          axis.identity.node,
          axis.identity.vendor_id,
          axis.identity.product_code,
          profile_position | cyclic_velocity,
          "profile position and cyclic synchronous velocity",
          turn_radps / axis.gearing.velocity_units_per_motor_rps,
          config.plausibility.standstill_radps,
          config.timing.sdo_timeout};
}

class NodeExamination {
 public:
  NodeExamination(const Expected& expected, Asking& asking, const BusEar& ear, Finding& finding)
      : expected_(expected), asking_(asking), ear_(ear), finding_(finding) {}

  void run(Stamp now) {
    if (!answers()) return;
    identity();
    firmware_and_name();
    state();
    modes();
    motion();
    heartbeat(now);
  }

 private:
  std::optional<std::uint32_t> number(ObjectAddress address) {
    const SdoResult result = asking_.read(expected_.node, address, expected_.sdo_timeout);
    return result.outcome == SdoResult::Outcome::ok ? result.value() : std::nullopt;
  }

  std::string text(ObjectAddress address) {
    const SdoResult result = asking_.read(expected_.node, address, expected_.sdo_timeout);
    if (result.outcome != SdoResult::Outcome::ok) return {};
    return {result.data.begin(), result.data.end()};
  }

  void tell(const std::string& what) { finding_.found += (finding_.found.empty() ? "" : ", ") + what; }

  bool answers() {
    const SdoResult result = asking_.read(expected_.node, device_type, expected_.sdo_timeout);
    if (result.outcome == SdoResult::Outcome::ok) {
      type_ = result.value();
      return true;
    }
    const HeardNode& heard = ear_.node(expected_.node);
    if (result.outcome != SdoResult::Outcome::timeout) {
      tell("answers, but not as a CANopen device must");
      finding_.wrong(result.describe(), "check that only one device has this node id");
    } else if (heard.heartbeats == 0) {
      tell("silent");
      finding_.wrong("never answers and sends no heartbeat",
                     "check its power, its node id, the bit rate and the bus' plug");
    } else {
      tell(fmt::format("heartbeat in {}, no answer", hw::to_string(heard.state)));
      finding_.wrong("sends a heartbeat but answers no question",
                     heard.state == hw::NmtState::stopped ? "it was stopped by a master: switch it off and on"
                                                          : "switch it off and on; if that does not help, replace it");
    }
    return false;
  }

  void identity() {
    const auto vendor = number(vendor_id);
    const auto product = number(product_code);
    const auto serial = number(serial_number);
    finding_.values.emplace_back("vendor_id", std::int64_t{vendor.value_or(0)});
    finding_.values.emplace_back("product_code", std::int64_t{product.value_or(0)});
    finding_.values.emplace_back("serial_number", std::int64_t{serial.value_or(0)});
    if (type_ && (*type_ & 0xFFFFU) != drive_profile) {
      finding_.wrong(fmt::format("is no drive: device type {:08X}", *type_), "check the node ids on the bus");
    }
    if (vendor == expected_.vendor_id && product == expected_.product_code) return;
    finding_.wrong(fmt::format("wrong identity: vendor {:08X} product {:08X}, the rig says {:08X} and {:08X}",
                               vendor.value_or(0), product.value_or(0), expected_.vendor_id, expected_.product_code),
                   "check the node ids, or put the new drive's numbers into the rig");
  }

  void firmware_and_name() {
    const std::string name = text(device_name);
    const std::string version = text(firmware);
    if (!name.empty()) tell(name);
    if (!version.empty()) tell("firmware " + version);
    finding_.values.emplace_back("name", name);
    finding_.values.emplace_back("firmware", version);
  }

  void state() {
    const auto word = number(statusword);
    const auto errors = number(error_register);
    const auto state = word ? hw::decode_statusword(static_cast<std::uint16_t>(*word)) : hw::Cia402State::unknown;
    tell(hw::to_string(state));
    finding_.values.emplace_back("state", std::string(hw::to_string(state)));
    finding_.values.emplace_back("error_register", std::int64_t{errors.value_or(0)});
    switch (state) {
      case hw::Cia402State::fault:
      case hw::Cia402State::fault_reaction_active: {
        const auto code = static_cast<std::uint16_t>(number(error_code).value_or(0));
        finding_.wrong(fmt::format("is in fault: {:04X} ({})", code, hw::emergency_meaning(code)),
                       "remove the cause; the fault is reset when a throw is armed");
        break;
      }
      case hw::Cia402State::unknown:
        finding_.wrong("its statusword is none of the standard's", "check that it is a CiA 402 drive");
        break;
      case hw::Cia402State::operation_enabled:
        finding_.wrong("has power on its motor", "somebody commands it: end the other program, or press the stop");
        break;
      case hw::Cia402State::quick_stop_active:
        finding_.note("stands in quick stop", "it is left when a throw is armed");
        break;
      default:
        if (errors.value_or(0) != 0) {
          finding_.wrong(fmt::format("error register is {:02X}", *errors), "read the drive's own error list (1003)");
        }
    }
  }

  void modes() {
    const auto mode = number(mode_display);
    const auto supported = number(supported_modes);
    if (mode) finding_.values.emplace_back("mode", std::int64_t{static_cast<std::int8_t>(*mode)});
    if (supported && (*supported & expected_.modes) != expected_.modes) {
      finding_.wrong(fmt::format("wrong mode: it can not do {} (6502 is {:08X})", expected_.mode_names, *supported),
                     "load the firmware that can, or take another drive");
    }
  }

  void motion() {
    const auto raw = number(velocity);
    if (!raw) return;
    const double axis_radps = static_cast<std::int32_t>(*raw) * expected_.radps_per_unit;
    finding_.values.emplace_back("axis_radps", axis_radps);
    if (std::abs(axis_radps) > expected_.standstill_radps) {
      finding_.wrong(fmt::format("turns with {:.2f} rad/s", axis_radps), "let the robot stand and ask again");
    }
  }

  void heartbeat(Stamp now) {
    const HeardNode& heard = ear_.node(expected_.node);
    finding_.values.emplace_back("sdo_latency_ms", 1e3 * asking_.latency_s);
    if (const auto period_s = heard.period_s()) {
      finding_.values.emplace_back("heartbeat_period_ms", 1e3 * *period_s);
      finding_.values.emplace_back("heartbeat_age_ms", 1e3 * seconds(now - heard.last));
      tell(fmt::format("heartbeat {:.0f} ms in {}", 1e3 * *period_s, hw::to_string(heard.state)));
    } else {
      tell("no heartbeat yet");  // it is switched on by the boot
    }
    tell(fmt::format("answers in {:.1f} ms", 1e3 * asking_.latency_s));
  }

  const Expected& expected_;
  Asking& asking_;
  const BusEar& ear_;
  Finding& finding_;
  std::optional<std::uint32_t> type_;
};

std::vector<Expected> expected_nodes(const std::optional<hw::TwoWheelDriveConfig>& wheels,
                                     const std::optional<hw::TwoAxisHeadConfig>& head) {
  std::vector<Expected> nodes;
  if (wheels) {
    nodes.push_back(expected(wheels->left, *wheels));
    nodes.push_back(expected(wheels->right, *wheels));
  }
  if (head) {
    nodes.push_back(expected(head->pan, *head));
    nodes.push_back(expected(head->tilt, *head));
  }
  return nodes;
}

// Nodes that the rig does not declare may be right there; a missing one may be among them under a wrong number.
void tell_strangers(const std::set<std::uint8_t>& known, const BusEar& ear, Finding& bus) {
  std::vector<int> strangers;
  for (std::uint8_t id = 1; id <= 127; ++id) {
    if (ear.node(id).heartbeats > 0 && !known.contains(id)) strangers.push_back(id);
  }
  if (strangers.empty()) return;
  bus.note(fmt::format("node {} {} heard, and the rig does not declare it", fmt::join(strangers, ", "),
                       strangers.size() == 1 ? "is" : "are"),
           "if it is one of the rig's devices, correct its node number there or in the device");
}

void describe_bus(const BusEar& ear, Duration listened, Site& site, Finding& bus) {
  bus.device = "CAN bus";
  bus.line = site.can_line();
  const double frames_per_s = static_cast<double>(ear.frames()) / seconds(listened);
  bus.found = fmt::format("{}, {:.0f} frames/s", site.can().up() ? "up" : "down", frames_per_s);
  bus.values.emplace_back("frames_per_s", frames_per_s);
  bus.values.emplace_back("other_master_frames", static_cast<std::int64_t>(ear.other_master()));
  site.describe_can(bus);
  if (!site.can().up() && bus.remarks.empty()) bus.wrong("the bus is down", "check adapter, wiring and terminations");
  if (ear.other_master() > 0) {
    bus.wrong(fmt::format("another master is on the bus ({} of its frames)", ear.other_master()),
              "end the other program that commands these drives");
  }
}

// All at once means the bus, not each of them.
void tell_if_all_are_silent(const std::vector<Finding>& nodes, const BusEar& ear, Finding& bus) {
  if (nodes.empty() || ear.frames() > 0 || !bus.remarks.empty()) return;
  bus.wrong("nothing at all is heard on the bus",
            "check the bit rate (ip -details link show) against the drives', the plug, and the drives' supply");
}

}  // namespace

std::vector<Finding> examine_drives(const std::optional<hw::TwoWheelDriveConfig>& wheels,
                                    const std::optional<hw::TwoAxisHeadConfig>& head, Site& site) {
  const std::vector<Expected> nodes = expected_nodes(wheels, site.has_head() ? head : std::nullopt);
  std::set<std::uint8_t> ids;
  for (const Expected& node : nodes) ids.insert(node.node);
  BusEar ear(ids, wheels ? wheels->master_node : head ? head->master_node : std::uint8_t{0});
  Asking asking(site, ear);
  const Stamp begin = site.now();
  asking.listen(listening);

  std::vector<Finding> drives;
  for (const Expected& node : nodes) {
    Finding& finding = drives.emplace_back();
    finding.device = node.name;
    finding.line = fmt::format("{}, node {}", site.can_line(), node.node);
    if (site.can().up()) {
      NodeExamination(node, asking, ear, finding).run(site.now());
    } else {
      finding.found = "not asked";
      finding.note("can not be asked while the bus is down", "bring the bus up and ask again");
    }
  }

  Finding bus;
  describe_bus(ear, site.now() - begin, site, bus);
  tell_if_all_are_silent(drives, ear, bus);
  tell_strangers(ids, ear, bus);
  drives.insert(drives.begin(), std::move(bus));
  return drives;
}

}  // namespace hogline::doctor
