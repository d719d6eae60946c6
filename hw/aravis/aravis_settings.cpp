#include "hw/aravis/aravis_settings.hpp"

#include <cmath>
#include <cstdio>

namespace hogline::hw::aravis {
namespace {

constexpr double microseconds = 1e6;
constexpr double tolerance = 0.05;  // cameras round to their own steps

using Result = std::optional<SourceFault>;

Result refused(std::string what) { return SourceFault{DeviceErrorKind::refused, std::move(what)}; }

Result differs(const char* what, double is, double wanted, const char* unit) {
  char text[160];
  std::snprintf(text, sizeof(text), "%s is %g %s after setting %g; the camera can not, or something else limits it",
                what, is, unit, wanted);
  return refused(text);
}

std::string read_text(ArvCamera* camera, const char* feature) {
  Failure failure;
  const char* text = arv_camera_get_string(camera, feature, failure.place());
  return failure || text == nullptr ? std::string("unknown") : std::string(text);
}

Result set_region(ArvCamera* camera, const AravisConfig& config) {
  Failure failure;
  if (config.offset_x_px && config.offset_y_px) {
    arv_camera_set_region(camera, *config.offset_x_px, *config.offset_y_px, config.width_px, config.height_px,
                          failure.place());
    if (failure) return refused(failure.text("setting the region"));
  }
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  arv_camera_get_region(camera, &x, &y, &width, &height, failure.place());
  if (failure) return refused(failure.text("reading the region"));
  const bool moved = config.offset_x_px && (x != *config.offset_x_px || y != *config.offset_y_px);
  if (width == config.width_px && height == config.height_px && !moved) return std::nullopt;
  char text[200];
  std::snprintf(text, sizeof(text),
                "the camera gives %dx%d from (%d, %d), the rig says %dx%d; set the camera's region, or correct the rig "
                "and calibrate",
                width, height, x, y, config.width_px, config.height_px);
  return SourceFault{DeviceErrorKind::implausible, text};
}

Result set_pixel_format(ArvCamera* camera, const AravisConfig& config) {
  Failure failure;
  arv_camera_set_pixel_format_from_string(camera, config.pixel_format.c_str(), failure.place());
  if (!failure) return std::nullopt;
  return refused(failure.text(("setting pixel format " + config.pixel_format).c_str()));
}

Result set_running(ArvCamera* camera) {
  Failure failure;
  arv_camera_set_acquisition_mode(camera, ARV_ACQUISITION_MODE_CONTINUOUS, failure.place());
  if (failure) return refused(failure.text("setting continuous acquisition"));
  arv_camera_clear_triggers(camera, failure.place());  // cameras without triggers say so; they run freely anyway
  return std::nullopt;
}

Result set_exposure(ArvCamera* camera, const AravisConfig& config) {
  Failure failure;
  if (arv_camera_is_exposure_auto_available(camera, nullptr)) {
    arv_camera_set_exposure_time_auto(camera, ARV_AUTO_OFF, failure.place());
    if (failure) return refused(failure.text("switching off automatic exposure"));
  }
  arv_camera_set_exposure_time(camera, config.exposure_s * microseconds, failure.place());
  if (failure) return refused(failure.text("setting the exposure"));
  const double is_s = arv_camera_get_exposure_time(camera, failure.place()) / microseconds;
  if (failure) return refused(failure.text("reading the exposure"));
  if (std::abs(is_s - config.exposure_s) > tolerance * config.exposure_s) {
    return differs("exposure", is_s, config.exposure_s, "s");
  }
  return std::nullopt;
}

Result set_gain(ArvCamera* camera, const AravisConfig& config) {
  if (!config.gain_db) return std::nullopt;
  Failure failure;
  if (arv_camera_is_gain_auto_available(camera, nullptr)) {
    arv_camera_set_gain_auto(camera, ARV_AUTO_OFF, failure.place());
    if (failure) return refused(failure.text("switching off automatic gain"));
  }
  arv_camera_set_gain(camera, *config.gain_db, failure.place());
  if (failure) return refused(failure.text("setting the gain"));
  return std::nullopt;
}

Result set_rate(ArvCamera* camera, const AravisConfig& config) {
  Failure failure;
  arv_camera_set_frame_rate(camera, config.frame_rate_hz, failure.place());
  if (failure) return refused(failure.text("setting the frame rate"));
  const double is_hz = arv_camera_get_frame_rate(camera, failure.place());
  if (failure) return refused(failure.text("reading the frame rate"));
  if (std::abs(is_hz - config.frame_rate_hz) > tolerance * config.frame_rate_hz) {
    return differs("frame rate", is_hz, config.frame_rate_hz, "Hz");
  }
  return std::nullopt;
}

Result set_packets(ArvCamera* camera, const AravisConfig& config) {
  if (config.packet_size_bytes == 0 || !arv_camera_is_gv_device(camera)) return std::nullopt;
  Failure failure;
  arv_camera_gv_set_packet_size(camera, config.packet_size_bytes, failure.place());
  if (failure) return refused(failure.text("setting the packet size"));
  return std::nullopt;
}

}  // namespace

CameraIdentity read_identity(ArvCamera* camera) {
  return {.vendor = read_text(camera, "DeviceVendorName"),
          .model = read_text(camera, "DeviceModelName"),
          .serial =
              [camera] {
                Failure failure;
                const char* serial = arv_camera_get_device_serial_number(camera, failure.place());
                return failure || serial == nullptr ? std::string("unknown") : std::string(serial);
              }(),
          .firmware = read_text(camera, "DeviceVersion"),
          .address = {}};
}

Result apply_settings(ArvCamera* camera, const AravisConfig& config) {
  if (auto fault = set_pixel_format(camera, config)) return fault;
  if (auto fault = set_region(camera, config)) return fault;
  if (auto fault = set_running(camera)) return fault;
  if (auto fault = set_exposure(camera, config)) return fault;
  if (auto fault = set_gain(camera, config)) return fault;
  if (auto fault = set_packets(camera, config)) return fault;
  return set_rate(camera, config);
}

}  // namespace hogline::hw::aravis
