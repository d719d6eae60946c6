#include "src/doctor/steel_site.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <thread>
#include <utility>
#include <variant>

#include "src/doctor/serial_device.hpp"
#include "src/steel/rig_camera.hpp"

namespace hogline::doctor {
namespace {

constexpr Duration can_period = std::chrono::milliseconds(1);

template <typename... Makers>
struct Overloaded : Makers... {
  using Makers::operator()...;
};

}  // namespace

SteelSite::SteelSite(const config::DeviceRig& rig) : rig_(rig) {
  if (!rig.rig.can_interface.empty()) can_.emplace(hw::SocketCanConfig{.interface = rig.rig.can_interface}, now());
  if (rig.modbus) modbus_.emplace(*rig.modbus);
  if (rig.gyro) gyro_.emplace(gyro_port_.emplace(rig.gyro->port), rig.gyro->device);
}

void SteelSite::pass(Duration span) {
  for (const Stamp end = now() + span; now() < end;) {
    std::this_thread::sleep_for(std::min(can_period, Duration(end - now())));
    if (can_) can_->step(now());
  }
}

std::string SteelSite::can_line() const { return "CAN " + rig_.rig.can_interface; }

void SteelSite::describe_can(Finding& finding) const {
  const hw::SocketCanState& state = can_->state();
  finding.found = can_->up() ? fmt::format("{}, controller {}", finding.found, hw::to_string(state.controller))
                             : std::string(hw::to_string(state.phase));
  finding.values.emplace_back("kernel_drops", static_cast<std::int64_t>(state.counters.kernel_drops));
  finding.values.emplace_back("error_frames", static_cast<std::int64_t>(state.counters.error_frames));
  finding.values.emplace_back("unconfirmed", static_cast<std::int64_t>(state.counters.unconfirmed));
  if (hw::CanSocket::open(rig_.rig.can_interface, {}).error == EAFNOSUPPORT) {
    finding.wrong("this machine's kernel has no CAN",
                  "boot a kernel with CONFIG_CAN (Debian's has it), or use --simulated");
  } else if (const auto error = can_->error()) {
    finding.wrong(error->what, "see doc/socketcan.md; the drives can not be asked until the bus is up");
  } else if (state.controller != hw::CanControllerState::active) {
    finding.wrong(fmt::format("the controller is in {}", hw::to_string(state.controller)),
                  "check the wiring, the two 120 ohm terminations and the bit rate");
  } else if (state.counters.error_frames > 0) {
    finding.note(fmt::format("{} error frames", state.counters.error_frames), "check plugs, shield and terminations");
  }
}

std::string SteelSite::modbus_line() const {
  return std::visit(
      Overloaded{[](const hw::ModbusTcp& tcp) { return fmt::format("Modbus tcp {}:{}", tcp.address, tcp.port); },
                 [](const hw::ModbusRtu& rtu) { return fmt::format("Modbus rtu {} {}", rtu.device, rtu.baud); }},
      rig_.modbus->line.line);
}

void SteelSite::describe_modbus_silence(Finding& finding) const {
  if (const auto* rtu = std::get_if<hw::ModbusRtu>(&rig_.modbus->line.line))
    describe_serial_device(rtu->device, finding);
}

void SteelSite::describe_gyro_silence(Finding& finding) const {
  describe_serial_device(rig_.gyro->port.device, finding);
}

std::string SteelSite::gyro_line() const {
  return fmt::format("serial {} {}", rig_.gyro->port.device, rig_.gyro->port.baud);
}

std::string SteelSite::camera_line(const std::string& name) const { return describe_source(rig_.rig.source(name)); }

std::string SteelSite::camera_advice(const std::string& name) const {
  const auto& device = rig_.rig.source(name).device;
  const bool recorded =
      std::holds_alternative<config::FolderSource>(device) || std::holds_alternative<config::VideoSource>(device);
  return recorded ? fmt::format("correct cameras.{}.source or the camera's size in the rig, or the recording", name)
                  : "";
}

hw::Camera* SteelSite::camera(const std::string& name) {
  if (const auto open = cameras_.find(name); open != cameras_.end()) return open->second.get();
  return cameras_.emplace(name, open_rig_camera(rig_.rig, name, clock_)).first->second.get();
}

void SteelSite::describe_camera(const std::string& name, Finding& finding) const {
  const auto open = cameras_.find(name);
  const auto* camera = open == cameras_.end() ? nullptr : dynamic_cast<const hw::AravisCamera*>(open->second.get());
  if (camera == nullptr) return;
  const hw::FeedState state = camera->state();
  if (!state.identity.serial.empty()) {
    finding.found = state.identity.describe() + ", " + finding.found;
    finding.values.emplace_back("model", state.identity.model);
    finding.values.emplace_back("firmware", state.identity.firmware);
  }
  finding.values.emplace_back("incomplete", static_cast<std::int64_t>(state.counters.incomplete));
  finding.values.emplace_back("lost", static_cast<std::int64_t>(state.counters.lost));
  finding.values.emplace_back("mute_starts", static_cast<std::int64_t>(state.counters.mute_starts));
  // The first buffer of a stream may have begun before we listened.
  if (state.counters.incomplete > 1 || state.counters.lost > 0) {
    finding.note(fmt::format("{} incomplete and {} lost of {} frames", state.counters.incomplete, state.counters.lost,
                             state.counters.frames + state.counters.incomplete + state.counters.lost),
                 "raise the packet size, the network card's MTU and net.core.rmem_max (doc/cameras.md)");
  }
}

}  // namespace hogline::doctor
