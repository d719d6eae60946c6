#include "src/config/camera_source.hpp"

#include <nlohmann/json.hpp>

#include "src/config/config_error.hpp"
#include "src/config/section.hpp"

namespace hogline::config {
namespace {

using nlohmann::json;

hw::CameraStampMeaning stamp_of(const std::string& word) {
  if (word == "exposure_start") return hw::CameraStampMeaning::exposure_start;
  if (word == "exposure_end") return hw::CameraStampMeaning::exposure_end;
  return hw::CameraStampMeaning::not_used;
}

hw::AravisConfig read_aravis(const std::string& name, const Section& camera, Duration silence_limit) {
  const Section s = camera.section("source").section("aravis");
  hw::AravisConfig a;
  a.name = name + " camera";
  a.serial = s.word("serial");
  if (s.has("address")) a.address = s.word("address");
  a.width_px = camera.integer("width_px");
  a.height_px = camera.integer("height_px");
  if (s.has("offset_x_px")) a.offset_x_px = s.integer("offset_x_px");
  if (s.has("offset_y_px")) a.offset_y_px = s.integer("offset_y_px");
  a.pixel_format = s.word("pixel_format");
  a.exposure_s = s.number("exposure_s");
  if (s.has("gain_db")) a.gain_db = s.number("gain_db");
  a.frame_rate_hz = s.number("frame_rate_hz");
  if (s.has("packet_size_bytes")) a.packet_size_bytes = s.integer("packet_size_bytes");
  a.stamp = stamp_of(s.word("stamp"));
  a.latency = s.duration("latency_s");
  a.first_frame_limit = s.duration("first_frame_s");
  a.silence_limit = silence_limit;
  a.retry_delay = s.duration("retry_s");
  return a;
}

FolderSource read_folder(const Section& s) {
  return {.path = s.has("path") ? s.word("path") : std::string(),
          .rate_hz = s.has("rate_hz") ? s.number("rate_hz") : 0.0,
          .stamps = s.has("stamps") ? s.word("stamps") : std::string()};
}

}  // namespace

CameraSource read_camera_source(const std::string& name, const json& camera, const Document& document) {
  const std::string key = "cameras." + name + ".source";
  const auto refuse = [&](const std::string& where, const std::string& what) {
    throw ConfigError(document.file, document.line_of(where), where, "", what);
  };
  const Section whole(camera);
  const Section s = whole.section("source");
  int kinds = 0;
  for (const char* kind : {"simulated", "shared_memory", "aravis", "folder", "video"}) kinds += s.has(kind) ? 1 : 0;
  if (kinds != 1) refuse(key, "must hold exactly one of simulated, shared_memory, aravis, folder, video");

  CameraSource source;
  source.max_age = s.duration("max_age_s");
  source.silence_limit = s.duration("silence_limit_s");
  if (s.has("aravis")) {
    const hw::AravisConfig a = read_aravis(name, whole, source.silence_limit);
    if (a.offset_x_px.has_value() != a.offset_y_px.has_value()) {
      refuse(key + ".aravis", "must hold both offset_x_px and offset_y_px, or neither");
    }
    if (a.exposure_s * a.frame_rate_hz > 1.0) refuse(key + ".aravis", "exposure_s is longer than a frame's time");
    source.device = a;
  } else if (s.has("folder")) {
    const FolderSource f = read_folder(s.section("folder"));
    const bool listed = !f.stamps.empty() && f.path.empty() && f.rate_hz == 0.0;
    const bool steady = f.stamps.empty() && !f.path.empty() && f.rate_hz > 0.0;
    if (!listed && !steady) refuse(key + ".folder", "must hold path and rate_hz, or stamps alone");
    source.device = f;
  } else if (s.has("shared_memory")) {
    source.device = SharedMemorySource{s.word("shared_memory")};
  } else if (s.has("video")) {
    const Section v = s.section("video");
    source.device = VideoSource{v.word("path"), v.has("rate_hz") ? v.number("rate_hz") : 0.0};
  }
  return source;
}

}  // namespace hogline::config
