#include "src/doctor/modbus_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <span>

#include "hw/modbus/axis_registers.hpp"
#include "hw/modbus/robotiq_registers.hpp"

namespace hogline::doctor {
namespace {

using namespace std::chrono_literals;

constexpr int reads = 5;
constexpr int tries = 3;
constexpr Duration between_reads = 20ms;
constexpr Duration after_a_failure = 250ms;  // the line is opened again only after a delay

struct Answers {
  std::vector<double> latencies_ms;
  std::optional<hw::ModbusFault> fault;  ///< of the last try, if none was answered
};

// Reads a few times for the latency, the registers of the last one count.
Answers ask(Site& site, int unit, int address, std::span<std::uint16_t> registers) {
  Answers answers;
  int failures = 0;
  while (static_cast<int>(answers.latencies_ms.size()) < reads && failures < tries) {
    const auto begin = std::chrono::steady_clock::now();
    const auto fault = site.modbus().read_input(unit, address, registers, site.now());
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    if (fault) {
      answers.fault = fault;
      ++failures;
      site.pass(after_a_failure);
    } else {
      answers.latencies_ms.push_back(took.count());
      site.pass(between_reads);
    }
  }
  std::ranges::sort(answers.latencies_ms);
  if (!answers.latencies_ms.empty()) answers.fault.reset();
  return answers;
}

const char* advice_for(hw::DeviceErrorKind kind) {
  switch (kind) {
    case hw::DeviceErrorKind::disconnected:
      return "check its power, cable, address and port";
    case hw::DeviceErrorKind::refused:
      return "check the unit number, and that the device has this register map (doc/modbus.md)";
    case hw::DeviceErrorKind::timeout:
      return "the line is there and nobody answers: check the unit number, the baud rate and the device's power";
    default:
      return "what answers is no such device: check address and port, or on a serial line the wiring, the baud rate "
             "and "
             "that no other master talks";
  }
}

// False where there was no answer; the finding then says so.
bool answered(const Answers& answers, const Site& site, Finding& finding) {
  if (!answers.fault) {
    const double median_ms = answers.latencies_ms[answers.latencies_ms.size() / 2];
    finding.values.emplace_back("latency_ms", median_ms);
    finding.values.emplace_back("worst_latency_ms", answers.latencies_ms.back());
    finding.found += fmt::format(", answers in {:.1f} ms", median_ms);
    return true;
  }
  finding.found = "no answer";
  site.describe_modbus_silence(finding);
  if (!finding.remarks.empty()) return false;
  finding.wrong(fmt::format("{}: {}", to_string(answers.fault->kind), answers.fault->what),
                advice_for(answers.fault->kind));
  return false;
}

Finding at(Site& site, const char* device, int unit) {
  Finding finding;
  finding.device = device;
  finding.line = fmt::format("{}, unit {}", site.modbus_line(), unit);
  return finding;
}

const char* describe(const hw::robotiq::Status& s) {
  using hw::robotiq::Activation;
  using hw::robotiq::Object;
  if (s.activation != Activation::active)
    return s.activation == Activation::activating ? "activating" : "not activated";
  if (s.object == Object::moving) return "moving";
  if (s.object == Object::contact_closing) return "holding";
  if (s.object == Object::contact_opening) return "blocked while opening";
  return s.position < 128 ? "open" : "closed, empty";
}

Finding examine_jaws(const hw::JawsConfig& config, Site& site) {
  Finding finding = at(site, "jaws", config.unit);
  hw::robotiq::Registers registers{};
  const Answers answers = ask(site, config.unit, hw::robotiq::status_address, registers);
  const hw::robotiq::Status s = hw::robotiq::decode(registers);
  finding.found = fmt::format("{}, position {} of 255, {:.2f} A", describe(s), s.position, s.current_a);
  if (!answered(answers, site, finding)) return finding;
  finding.values.emplace_back("state", std::string(describe(s)));
  finding.values.emplace_back("position", std::int64_t{s.position});
  finding.values.emplace_back("fault", std::int64_t{s.fault});
  if (s.fault != 0) {
    finding.wrong("fault: " + hw::robotiq::describe_fault(s.fault),
                  "remove the cause, then switch the jaws off and on");
  }
  if (s.activation != hw::robotiq::Activation::active) {
    finding.note("not activated: the first grip moves the fingers through their whole stroke",
                 "keep hands away; put no stone in before");
  }
  return finding;
}

struct AxisFinding {
  Finding finding;
  std::optional<hw::axis::Status> status;
};

AxisFinding examine_axis(const char* device, hw::axis::Kind kind, const hw::AxisConfig& config, Site& site) {
  AxisFinding axis{at(site, device, config.unit), std::nullopt};
  std::array<std::uint16_t, 8> registers{};
  const Answers answers = ask(site, config.unit, hw::axis::status_address, registers);
  const hw::axis::Status s = hw::axis::decode(registers);
  axis.finding.found = s.moving ? "moving" : "at rest";
  if (!answered(answers, site, axis.finding)) return axis;
  axis.finding.values.emplace_back("kind", std::int64_t{s.kind});
  axis.finding.values.emplace_back("fault", std::int64_t{s.fault});
  axis.finding.values.emplace_back("watchdog_ms", std::int64_t{s.watchdog_ms});
  if (s.kind != static_cast<std::uint16_t>(kind)) {
    axis.finding.found = "another device";
    axis.finding.wrong(
        fmt::format("wrong identity: kind is {:04X}, a {} says {:04X}", s.kind, device, static_cast<unsigned>(kind)),
        "check the unit numbers");
    return axis;
  }
  axis.status = s;
  if (s.faulted) {
    const bool gone = s.fault == 0;
    axis.finding.wrong(
        "fault: " + hw::axis::describe_fault(s.fault),
        gone ? "it is reset when a throw is armed" : "remove the cause; it is reset when a throw is armed");
  }
  if (s.moving) axis.finding.note("moves, though nobody asked it here", "is another program running?");
  return axis;
}

}  // namespace

ModbusFindings examine_modbus(const std::optional<hw::ModbusGripperConfig>& gripper,
                              const std::optional<hw::AxisConfig>& arm, Site& site) {
  ModbusFindings all;
  if (gripper) {
    all.findings.push_back(examine_jaws(gripper->jaws, site));
    all.findings.push_back(examine_axis("spin belt", hw::axis::Kind::belt, gripper->belt, site).finding);
  }
  if (!arm) return all;

  AxisFinding folding = examine_axis("arm", hw::axis::Kind::arm, *arm, site);
  if (folding.status) {
    all.arm_unfolded = folding.status->unfolded;
    const char* place = folding.status->unfolded ? "unfolded" : folding.status->folded ? "folded" : "between its ends";
    folding.finding.found = fmt::format("{}, {}", place, folding.finding.found);
    folding.finding.values.emplace_back("place", std::string(place));
    if (!folding.status->unfolded && !folding.status->folded && !folding.status->moving) {
      folding.finding.note("stands between its ends", "keep clear: the next order moves it");
    }
  }
  all.findings.push_back(std::move(folding.finding));
  return all;
}

}  // namespace hogline::doctor
