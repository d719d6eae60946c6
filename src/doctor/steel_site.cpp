#include "src/doctor/steel_site.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <thread>
#include <utility>
#include <variant>

#include "hw/files/recorded_camera.hpp"

namespace hogline::doctor {
namespace {

constexpr Duration can_period = std::chrono::milliseconds(1);

// A recording that can not be played.
class BrokenCamera final : public hw::Camera {
 public:
  explicit BrokenCamera(hw::DeviceError error) : error_(std::move(error)) {}
  std::optional<hw::Frame> latest(Stamp) override { return std::nullopt; }
  std::optional<hw::DeviceError> error() const override { return error_; }
  void rearm() override {}

 private:
  hw::DeviceError error_;
};

template <typename... Makers>
struct Overloaded : Makers... {
  using Makers::operator()...;
};

std::unique_ptr<hw::Camera> folder_camera(const config::FolderSource& folder, const std::string& name, cv::Size size,
                                          Stamp start) {
  hw::files::Recording recording = folder.stamps.empty() ? hw::files::read_folder(folder.path, folder.rate_hz)
                                                         : hw::files::read_stamps_file(folder.stamps);
  if (recording.problem.empty()) {
    return std::make_unique<hw::files::FolderCamera>(name, std::move(recording), size, start);
  }
  return std::make_unique<BrokenCamera>(
      hw::DeviceError{hw::DeviceErrorKind::disconnected, name, recording.problem, start});
}

}  // namespace

SteelSite::SteelSite(const config::ThrowerRig& rig)
    : rig_(rig),
      can_({.interface = rig.rig.can_interface}, clock_.now()),
      modbus_(rig.modbus),
      gyro_port_(rig.gyro_port),
      gyro_(gyro_port_, rig.gyro) {}

void SteelSite::pass(Duration span) {
  for (const Stamp end = now() + span; now() < end;) {
    std::this_thread::sleep_for(std::min(can_period, Duration(end - now())));
    can_.step(now());
  }
}

std::string SteelSite::can_line() const { return "CAN " + rig_.rig.can_interface; }

void SteelSite::describe_can(Finding& finding) const {
  const hw::SocketCanState& state = can_.state();
  finding.found = can_.up() ? fmt::format("{}, controller {}", finding.found, hw::to_string(state.controller))
                            : std::string(hw::to_string(state.phase));
  finding.values.emplace_back("kernel_drops", static_cast<std::int64_t>(state.counters.kernel_drops));
  finding.values.emplace_back("error_frames", static_cast<std::int64_t>(state.counters.error_frames));
  finding.values.emplace_back("unconfirmed", static_cast<std::int64_t>(state.counters.unconfirmed));
  if (hw::CanSocket::open(rig_.rig.can_interface, {}).error == EAFNOSUPPORT) {
    finding.wrong("this machine's kernel has no CAN",
                  "boot a kernel with CONFIG_CAN (Debian's has it), or use --simulated");
  } else if (const auto error = can_.error()) {
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
      rig_.modbus.line.line);
}

std::string SteelSite::gyro_line() const {
  return fmt::format("serial {} {}", rig_.gyro_port.device, rig_.gyro_port.baud);
}

std::string SteelSite::camera_line(const std::string& name) const {
  return std::visit(
      Overloaded{[](const config::SimulatedSource&) { return std::string("simulated"); },
                 [](const hw::AravisConfig& a) { return "aravis " + a.serial; },
                 [](const config::FolderSource& f) { return "folder " + (f.stamps.empty() ? f.path : f.stamps); },
                 [](const config::VideoSource& v) { return "video " + v.path; }},
      rig_.rig.source(name).device);
}

hw::Camera* SteelSite::camera(const std::string& name) {
  if (const auto open = cameras_.find(name); open != cameras_.end()) return open->second.get();
  const vision::Intrinsics& lens = rig_.rig.camera(name).intrinsics;
  const cv::Size size(lens.width_px, lens.height_px);
  const std::string device = name + " camera";
  std::unique_ptr<hw::Camera> camera =
      std::visit(Overloaded{[](const config::SimulatedSource&) { return std::unique_ptr<hw::Camera>(); },
                            [this](const hw::AravisConfig& a) -> std::unique_ptr<hw::Camera> {
                              return std::make_unique<hw::AravisCamera>(a, clock_);
                            },
                            [&](const config::FolderSource& f) { return folder_camera(f, device, size, now()); },
                            [&](const config::VideoSource& v) -> std::unique_ptr<hw::Camera> {
                              return std::make_unique<hw::files::VideoCamera>(device, v.path, v.rate_hz, size, now());
                            }},
                 rig_.rig.source(name).device);
  return cameras_.emplace(name, std::move(camera)).first->second.get();
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
