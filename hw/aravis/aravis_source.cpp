#include "hw/aravis/aravis_source.hpp"

#include <arv.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <utility>

#include "hw/aravis/aravis_settings.hpp"

namespace hogline::hw {
namespace {

constexpr int buffers = 8;
constexpr int socket_buffer_bytes = 4 << 20;  // a megapixel picture and a half; needs net.core.rmem_max of that size
constexpr std::uint64_t never = 0;

// The library's list of devices is one for the whole process.
std::mutex discovery_mutex;

std::string text_or_empty(const char* text) { return text == nullptr ? std::string() : std::string(text); }

struct Found {
  std::string device;  // what arv_camera_new() takes
  std::string address;
  std::string others;  // serial numbers of the cameras that are there
};

Found find(const AravisConfig& config) {
  if (!config.address.empty()) return {config.address, config.address, {}};
  const std::lock_guard lock(discovery_mutex);
  arv_update_device_list();
  Found found;
  for (unsigned int i = 0; i < arv_get_n_devices(); ++i) {
    const std::string serial = text_or_empty(arv_get_device_serial_nbr(i));
    if (serial == config.serial) {
      found.device = text_or_empty(arv_get_device_id(i));
      found.address = text_or_empty(arv_get_device_address(i));
    }
    found.others += (found.others.empty() ? "" : ", ") + serial;
  }
  return found;
}

SourceFault not_found(const AravisConfig& config, const Found& found) {
  const std::string others = found.others.empty() ? "no camera at all answers" : "there are: " + found.others;
  return {DeviceErrorKind::disconnected,
          "no camera with serial number " + config.serial + " (" + others + "); check power, cable and address range"};
}

void note_loss(ArvDevice*, gpointer lost) { static_cast<std::atomic<bool>*>(lost)->store(true); }

}  // namespace

std::string CameraIdentity::describe() const {
  std::string text = vendor + " " + model + " " + serial + " firmware " + firmware;
  return address.empty() ? text : text + " at " + address;
}

// Everything that is opened, and closed again in the right order.
struct AravisSource::Session {
  ArvCamera* camera = nullptr;
  ArvStream* stream = nullptr;
  ArvBuffer* given = nullptr;
  std::atomic<bool> lost{false};

  Session() = default;
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  ~Session() {
    if (camera != nullptr) {
      g_signal_handlers_disconnect_by_data(arv_camera_get_device(camera), &lost);
      // A camera that does not answer would make this call wait for seconds.
      if (stream != nullptr && !lost) arv_camera_stop_acquisition(camera, nullptr);
    }
    if (given != nullptr) g_object_unref(given);
    if (stream != nullptr) g_object_unref(stream);
    if (camera != nullptr) g_object_unref(camera);
  }

  std::optional<SourceFault> open_stream(const AravisConfig& config);
};

std::optional<SourceFault> AravisSource::Session::open_stream(const AravisConfig& config) {
  if (arv_camera_is_gv_device(camera)) {
    arv_camera_gv_set_stream_options(camera, ARV_GV_STREAM_OPTION_PACKET_SOCKET_DISABLED);
  }
  aravis::Failure failure;
  stream = arv_camera_create_stream(camera, nullptr, nullptr, failure.place());
  if (stream == nullptr) return SourceFault{DeviceErrorKind::disconnected, failure.text("opening the stream")};
  if (ARV_IS_GV_STREAM(stream)) {
    // A frame with missing packets holds up those after it for as long as it is retained.
    const auto retention_us = static_cast<unsigned int>(2e6 / config.frame_rate_hz);
    g_object_set(stream, "socket-buffer", ARV_GV_STREAM_SOCKET_BUFFER_FIXED, "socket-buffer-size", socket_buffer_bytes,
                 "frame-retention", retention_us, nullptr);
  }
  const unsigned int payload = arv_camera_get_payload(camera, failure.place());
  if (failure) return SourceFault{DeviceErrorKind::refused, failure.text("asking for the payload")};
  for (int i = 0; i < buffers; ++i) arv_stream_push_buffer(stream, arv_buffer_new_allocate(payload));
  g_signal_connect(arv_camera_get_device(camera), "control-lost", G_CALLBACK(note_loss), &lost);
  arv_camera_start_acquisition(camera, failure.place());
  if (failure) return SourceFault{DeviceErrorKind::refused, failure.text("starting the acquisition")};
  return std::nullopt;
}

AravisSource::AravisSource(const AravisConfig& config) : config_(config) {}
AravisSource::~AravisSource() = default;

std::optional<SourceFault> AravisSource::start() {
  session_.reset();
  const Found found = find(config_);
  if (found.device.empty()) return not_found(config_, found);

  auto session = std::make_unique<Session>();
  aravis::Failure failure;
  session->camera = arv_camera_new(found.device.c_str(), failure.place());
  if (session->camera == nullptr) {
    return SourceFault{DeviceErrorKind::disconnected, failure.text("opening") + "; another program may hold it"};
  }
  identity_ = aravis::read_identity(session->camera);
  identity_.address = found.address;
  if (identity_.serial != config_.serial) {
    return SourceFault{DeviceErrorKind::refused,
                       "serial number " + identity_.serial + " instead of " + config_.serial + " at " + found.address};
  }
  if (auto fault = aravis::apply_settings(session->camera, config_)) return fault;
  if (auto fault = session->open_stream(config_)) return fault;
  session_ = std::move(session);
  return std::nullopt;
}

void AravisSource::stop() { session_.reset(); }

std::size_t AravisSource::waiting() const {
  if (!session_) return 0;
  int empty = 0;
  int filled = 0;
  arv_stream_get_n_buffers(session_->stream, &empty, &filled);
  return static_cast<std::size_t>(std::max(filled, 0));
}

bool AravisSource::control_lost() const { return session_ && session_->lost; }

std::optional<CameraBuffer> AravisSource::next(Duration patience) {
  if (!session_) return std::nullopt;
  Session& s = *session_;
  if (s.given != nullptr) arv_stream_push_buffer(s.stream, std::exchange(s.given, nullptr));
  const auto patience_us =
      static_cast<std::uint64_t>(std::max<std::int64_t>(patience / std::chrono::microseconds(1), 0));
  s.given =
      patience_us == never ? arv_stream_try_pop_buffer(s.stream) : arv_stream_timeout_pop_buffer(s.stream, patience_us);
  if (s.given == nullptr) return std::nullopt;

  CameraBuffer buffer;
  buffer.frame_id = arv_buffer_get_frame_id(s.given);
  buffer.wall = Duration{static_cast<Duration::rep>(arv_buffer_get_system_timestamp(s.given))};
  if (const auto own = arv_buffer_get_timestamp(s.given); own != never)
    buffer.camera = Duration{static_cast<Duration::rep>(own)};
  buffer.complete = arv_buffer_get_status(s.given) == ARV_BUFFER_STATUS_SUCCESS &&
                    arv_buffer_get_payload_type(s.given) == ARV_BUFFER_PAYLOAD_TYPE_IMAGE;
  if (!buffer.complete) return buffer;  // nothing else may be asked of it
  std::size_t size = 0;
  const auto* bytes = static_cast<const std::uint8_t*>(arv_buffer_get_image_data(s.given, &size));
  buffer.bytes = {bytes, size};
  buffer.width_px = arv_buffer_get_image_width(s.given);
  buffer.height_px = arv_buffer_get_image_height(s.given);
  buffer.pixel_format = arv_buffer_get_image_pixel_format(s.given);
  return buffer;
}

}  // namespace hogline::hw
