#include "src/steel/rig_camera.hpp"

#include <utility>
#include <variant>

#include "hw/aravis/aravis_camera.hpp"
#include "hw/files/recorded_camera.hpp"
#include "hw/shared_frames/shared_camera.hpp"
#include "src/config/config_error.hpp"

namespace hogline {
namespace {

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

std::unique_ptr<hw::Camera> open_rig_camera(const config::Rig& rig, const std::string& name, const hw::Clock& clock) {
  const vision::Intrinsics& lens = rig.camera(name).intrinsics;
  const cv::Size size(lens.width_px, lens.height_px);
  const std::string device = name + " camera";
  return std::visit(
      Overloaded{[](const config::SimulatedSource&) { return std::unique_ptr<hw::Camera>(); },
                 [&](const hw::AravisConfig& a) -> std::unique_ptr<hw::Camera> {
                   return std::make_unique<hw::AravisCamera>(a, clock);
                 },
                 [&](const config::FolderSource& f) { return folder_camera(f, device, size, clock.now()); },
                 [&](const config::SharedMemorySource& s) -> std::unique_ptr<hw::Camera> {
                   return std::make_unique<hw::SharedCamera>(
                       hw::SharedCameraConfig{.name = device,
                                              .segment = s.segment,
                                              .width_px = static_cast<std::uint32_t>(lens.width_px),
                                              .height_px = static_cast<std::uint32_t>(lens.height_px),
                                              .silence_limit = rig.source(name).silence_limit});
                 },
                 [&](const config::VideoSource& v) -> std::unique_ptr<hw::Camera> {
                   return std::make_unique<hw::files::VideoCamera>(device, v.path, v.rate_hz, size, clock.now());
                 }},
      rig.source(name).device);
}

std::unique_ptr<hw::Camera> open_real_camera(const config::Rig& rig, const std::string& name, const hw::Clock& clock) {
  auto camera = open_rig_camera(rig, name, clock);
  if (camera) return camera;
  throw config::ConfigError(rig.file, 0, "cameras." + name + ".source", "simulated",
                            "must be shared_memory, aravis, folder or video: here nobody renders pictures");
}

hw::CameraWatch watch_of(const config::Rig& rig, const std::string& name) {
  const config::CameraSource source = rig.source(name);
  return {.name = name + " camera", .max_age = source.max_age, .silence_limit = source.silence_limit};
}

std::string describe_source(const config::CameraSource& source) {
  return std::visit(
      Overloaded{[](const config::SimulatedSource&) { return std::string("simulated"); },
                 [](const hw::AravisConfig& a) { return "aravis " + a.serial; },
                 [](const config::FolderSource& f) { return "folder " + (f.stamps.empty() ? f.path : f.stamps); },
                 [](const config::SharedMemorySource& s) { return "shared memory " + s.segment; },
                 [](const config::VideoSource& v) { return "video " + v.path; }},
      source.device);
}

}  // namespace hogline
