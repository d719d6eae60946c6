#include "hw/aravis/camera_feed.hpp"

#include <utility>

#include "hw/aravis/pixel_format.hpp"

namespace hogline::hw {
namespace {

constexpr int most_at_once = 8;
constexpr std::uint64_t patient_starts = 3;  // one start in six gives no frame with some cameras: three is a fault

std::string size_text(int width_px, int height_px) {
  return std::to_string(width_px) + "x" + std::to_string(height_px);
}

std::string ms_text(Duration span) { return std::to_string(span / std::chrono::milliseconds(1)) + " ms"; }

}  // namespace

const char* to_string(FeedPhase phase) {
  switch (phase) {
    case FeedPhase::closed:
      return "closed";
    case FeedPhase::starting:
      return "starting";
    case FeedPhase::streaming:
      return "streaming";
  }
  return "unknown";
}

CameraFeed::CameraFeed(FrameSource& source, AravisConfig config, Clocks clocks)
    : source_(source), config_(std::move(config)), clocks_(std::move(clocks)), stamps_(config_) {}

CameraFeed::~CameraFeed() {
  if (state_.phase != FeedPhase::closed) source_.stop();
}

std::optional<Frame> CameraFeed::step(Duration patience) {
  if (state_.phase == FeedPhase::closed) {
    if (clocks_().steady < retry_at_) return std::nullopt;
    open();
    if (state_.phase == FeedPhase::closed) return std::nullopt;
  }
  // Bounded: pictures may come faster than they are converted.
  std::optional<Frame> newest;
  auto buffer = source_.next(patience);
  for (int taken = 1; buffer; ++taken) {
    const bool last = source_.waiting() == 0 || taken == most_at_once;
    if (auto frame = take(*buffer, last)) newest = std::move(frame);
    buffer = last ? std::nullopt : source_.next(Duration{});
  }
  watch(clocks_().steady);
  return newest;
}

void CameraFeed::rearm() {
  state_.error.reset();
  mute_in_a_row_ = 0;
}

void CameraFeed::open() {
  const auto fault = source_.start();
  const Stamp now = clocks_().steady;
  state_.identity = source_.identity();
  if (fault) {
    retry_at_ = now + config_.retry_delay;
    return fail(fault->kind, fault->what, now);
  }
  ++state_.counters.starts;
  started_ = now;
  state_.phase = FeedPhase::starting;
  numbers_.restart();
  stamps_.restart();
}

void CameraFeed::close() {
  source_.stop();
  if (state_.phase == FeedPhase::streaming) ++state_.counters.outages;
  state_.phase = FeedPhase::closed;
  retry_at_ = clocks_().steady;  // at once; a start that fails waits
}

bool CameraFeed::usable(const CameraBuffer& buffer, bool backward, Stamp now) {
  FeedCounters& counters = state_.counters;
  if (!backward && !buffer.complete) {
    ++counters.incomplete;
    return false;
  }
  if (!backward && buffer.width_px == config_.width_px && buffer.height_px == config_.height_px) return true;
  ++counters.refused;
  fail(DeviceErrorKind::implausible,
       backward ? "frame numbers go back; the camera was started anew"
                : "a picture is " + size_text(buffer.width_px, buffer.height_px) + ", the rig says " +
                      size_text(config_.width_px, config_.height_px) + "; set the camera's region or correct the rig",
       now);
  return false;
}

// Numbers, counts and stamps are of every buffer; only the last one is worth a conversion.
std::optional<Frame> CameraFeed::take(const CameraBuffer& buffer, bool last) {
  const TimePair now = clocks_();
  FeedCounters& counters = state_.counters;
  const FrameNumbers::Step step = numbers_.next(buffer.frame_id);
  counters.lost += step.lost;
  if (!usable(buffer, step.backward, now.steady)) return std::nullopt;
  ++counters.frames;
  state_.last_frame = now.steady;
  state_.phase = FeedPhase::streaming;
  mute_in_a_row_ = 0;

  const FrameStamp stamp = stamps_.stamp_of(buffer, now);
  if (stamp.wall_replaced) ++counters.wall_replaced;
  if (stamp.camera_jumped) fail(DeviceErrorKind::implausible, "the camera's clock jumped", now.steady);
  if (last_stamp_ && stamp.middle <= *last_stamp_) {
    ++counters.refused;
    fail(DeviceErrorKind::implausible, "a frame's time lies before the last one's; check the camera's clock",
         now.steady);
    return std::nullopt;
  }
  last_stamp_ = stamp.middle;
  if (!last) {
    ++counters.overtaken;
    return std::nullopt;
  }
  auto picture = pfnc::to_picture(buffer.bytes, buffer.width_px, buffer.height_px, buffer.pixel_format);
  if (picture) return Frame{std::move(*picture), stamp.middle, step.number};
  ++counters.refused;
  fail(DeviceErrorKind::implausible,
       "a picture has pixel format " + pfnc::name(buffer.pixel_format) + " in " + std::to_string(buffer.bytes.size()) +
           " bytes; set one of Mono8, BGR8, RGB8, Bayer..8",
       now.steady);
  return std::nullopt;
}

void CameraFeed::watch(Stamp now) {
  if (source_.control_lost()) {
    fail(DeviceErrorKind::disconnected, "another program has taken the camera, or it does not answer", now);
    return close();
  }
  if (state_.phase == FeedPhase::starting && now - started_ > config_.first_frame_limit) {
    ++state_.counters.mute_starts;
    if (++mute_in_a_row_ >= patient_starts) {
      fail(DeviceErrorKind::timeout,
           "no frame after " + std::to_string(mute_in_a_row_) +
               " starts; check the packet size against the network card's MTU, the firewall and the trigger",
           now);
    }
    return close();
  }
  if (state_.phase == FeedPhase::streaming && now - state_.last_frame > config_.silence_limit) {
    fail(DeviceErrorKind::timeout, "no frame for " + ms_text(now - state_.last_frame) + "; check power and cable", now);
    return close();
  }
}

void CameraFeed::fail(DeviceErrorKind kind, std::string what, Stamp now) {
  if (!state_.error) state_.error = DeviceError{kind, config_.name, std::move(what), now};
}

}  // namespace hogline::hw
