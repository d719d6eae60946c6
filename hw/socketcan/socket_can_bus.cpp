#include "hw/socketcan/socket_can_bus.hpp"

#include <cassert>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <utility>

#include "hw/socketcan/receive_stamp.hpp"

namespace hogline::hw {

namespace {

// Neither a babbling node nor a flood of error frames may hold a control period up.
constexpr int most_messages_a_call = 256;
constexpr Duration oldest_frame = std::chrono::seconds(2);

Duration wall_now() {
  timespec wall{};
  clock_gettime(CLOCK_REALTIME, &wall);
  return std::chrono::seconds{wall.tv_sec} + std::chrono::nanoseconds{wall.tv_nsec};
}

// A thread that is interrupted between the two readings would give every stamp the length of its interruption.
ClockPair both_clocks() {
  constexpr Duration close_enough = std::chrono::microseconds{50};
  ClockPair best;
  Duration least = Duration::max();
  for (int attempt = 0; attempt < 3 && least > close_enough; ++attempt) {
    const Stamp before = std::chrono::steady_clock::now();
    const Duration wall = wall_now();
    const Stamp after = std::chrono::steady_clock::now();
    if (after - before >= least) continue;
    least = after - before;
    best = {wall, before + least / 2};
  }
  return best;
}

}  // namespace

const char* to_string(SocketCanPhase phase) {
  switch (phase) {
    case SocketCanPhase::no_interface:
      return "no interface";
    case SocketCanPhase::link_down:
      return "link down";
    case SocketCanPhase::bus_off:
      return "bus-off";
    case SocketCanPhase::running:
      return "running";
  }
  return "unknown";
}

SocketCanBus::SocketCanBus(SocketCanConfig config, Stamp now) : config_(std::move(config)), now_(now) {
  record_.interface = config_.interface;
  if (!config_.receive.empty()) {
    kernel_filters_ = config_.receive;
    kernel_filters_.insert(kernel_filters_.end(), config_.own.begin(), config_.own.end());
  }
  state_.since = now;
  open(now);
}

void SocketCanBus::step(Stamp now) {
  now_ = now;
  if (!frames_) {
    if (now >= next_open_) open(now);
    return;
  }

  if (std::exchange(recovered_, false)) enter(SocketCanPhase::running);
  on_socket_error(frames_->pending_error());
  take_error_frames();
  watch_link();
}

void SocketCanBus::open(Stamp now) {
  next_open_ = now + config_.reopen_period;
  auto frames = CanSocket::open(config_.interface, {kernel_filters_, false});
  auto errors = CanSocket::open(config_.interface, {{}, true});
  if (!frames.socket || !errors.socket) {
    closed_by_ = frames.socket ? errors.error : frames.error;
    return;
  }
  frames_ = std::move(frames.socket);
  errors_ = std::move(errors.socket);
  drops_seen_ = 0;
  state_.controller = CanControllerState::active;
  ++state_.counters.opened;
  enter(SocketCanPhase::link_down);
  watch_link();
}

void SocketCanBus::close(int reason) {
  frames_.reset();
  errors_.reset();
  closed_by_ = reason;
  next_open_ = now_ + config_.reopen_period;
  enter(SocketCanPhase::no_interface);
}

void SocketCanBus::enter(SocketCanPhase phase) {
  if (phase == state_.phase) return;
  if (state_.phase == SocketCanPhase::running) ++state_.counters.outages;
  state_.phase = phase;
  state_.since = now_;
  state_.counters.unconfirmed += sent_.size();
  sent_.clear();
  recovered_ = false;
  link_was_down_ = false;
}

// A link that was seen down during a bus-off and is up again has been restarted, by a driver that does not say so.
void SocketCanBus::watch_link() {
  if (!frames_ || recovered_) return;
  int error = 0;
  const bool link_up = frames_->link_up(config_.interface, error);
  if (error != 0) return close(error);
  if (state_.phase == SocketCanPhase::running && !link_up) return enter(SocketCanPhase::link_down);
  if (state_.phase == SocketCanPhase::bus_off && !link_up) link_was_down_ = true;
  const bool waiting =
      state_.phase == SocketCanPhase::link_down || (state_.phase == SocketCanPhase::bus_off && link_was_down_);
  if (waiting && link_up) {
    recovered_ = true;
    state_.controller = CanControllerState::active;
  }
}

void SocketCanBus::on_socket_error(int error) {
  if (error == 0 || error == EAGAIN) return;
  if (error != ENETDOWN) return close(error);
  enter(SocketCanPhase::link_down);
  frames_->pending_error();  // both sockets are told once; one outage is enough
  errors_->pending_error();
}

void SocketCanBus::take_error_frames() {
  for (int i = 0; i < most_messages_a_call && errors_; ++i) {
    const auto [message, error] = errors_->receive();
    if (!message) return on_socket_error(error);
    if (message->kind != CanMessageKind::error) continue;
    tell_tap(message->frame, message->wall, CanDirection::received, true);
    on_error_frame(decode_error_frame(message->frame.id, message->frame.data));
  }
}

void SocketCanBus::on_error_frame(const CanErrorFrame& error) {
  ++state_.counters.error_frames;
  if (error.counters) state_.error_counters = *error.counters;
  if (!error.state) return;
  state_.controller = *error.state;
  if (*error.state == CanControllerState::bus_off) {
    ++state_.counters.bus_offs;
    enter(SocketCanPhase::bus_off);
    recovered_ = false;
  } else if (state_.phase == SocketCanPhase::bus_off) {
    recovered_ = true;
  }
}

// After a bus-off the kernel takes frames and loses them without a word, so the error frames are looked at first.
CanSendResult SocketCanBus::send(const CanFrame& frame) {
  assert(frame.length <= frame.data.size());
  take_error_frames();
  if (!up()) {
    ++state_.counters.refused;
    return CanSendResult::bus_down;
  }

  if (matches_any(config_.one_at_a_time, frame) && sent_.holds(frame)) {
    ++state_.counters.would_block;
    return CanSendResult::would_block;
  }

  const int error = frames_->send(frame);
  if (error == EAGAIN || error == ENOBUFS) {
    ++state_.counters.would_block;
    return CanSendResult::would_block;
  }
  if (error != 0) {
    on_socket_error(error);
    ++state_.counters.refused;
    return CanSendResult::bus_down;
  }

  ++state_.counters.sent;
  const bool confirmable = kernel_filters_.empty() || matches_any(kernel_filters_, frame);
  if (confirmable && !sent_.add(frame, now_)) ++state_.counters.unconfirmed;
  if (!confirmable) tell_tap(frame, Duration::zero(), CanDirection::transmitted, false);
  return CanSendResult::sent;
}

std::optional<StampedCanFrame> SocketCanBus::receive() {
  for (int i = 0; i < most_messages_a_call && frames_; ++i) {
    const auto [message, error] = frames_->receive();
    if (!message) {
      on_socket_error(error);
      expire_unconfirmed();
      return std::nullopt;
    }
    count_drops(*message);
    if (message->kind == CanMessageKind::confirmation) {
      on_own_frame(*message);
      continue;
    }
    tell_tap(message->frame, message->wall, CanDirection::received, false);
    if (matches_any(config_.own, message->frame)) ++state_.counters.foreign;
    ++state_.counters.received;
    return StampedCanFrame{message->frame, stamp_of(*message)};
  }
  return std::nullopt;
}

void SocketCanBus::on_own_frame(const CanMessage& message) {
  if (sent_.confirm(message.frame)) ++state_.counters.confirmed;
  state_.unconfirmed_since = sent_.oldest();
  tell_tap(message.frame, message.wall, CanDirection::transmitted, false);
}

// Only when everything that came was read: confirmations that waited while the program did are not late.
void SocketCanBus::expire_unconfirmed() {
  state_.counters.unconfirmed += sent_.expire(now_ - config_.confirm_deadline);
  state_.unconfirmed_since = sent_.oldest();
}

// The kernel counts from the socket's opening, in 32 bits that wrap.
void SocketCanBus::count_drops(const CanMessage& message) {
  if (!message.drops) return;
  state_.counters.kernel_drops += *message.drops - drops_seen_;
  drops_seen_ = *message.drops;
}

Stamp SocketCanBus::stamp_of(const CanMessage& message) {
  const ClockPair now = both_clocks();
  if (const auto stamp = to_steady(message.wall, now, oldest_frame)) return *stamp;
  ++state_.counters.stamps_replaced;
  return now.steady;
}

void SocketCanBus::tell_tap(const CanFrame& frame, Duration wall, CanDirection direction, bool error_frame) {
  if (tap_ == nullptr) return;
  record_.unix_time =
      std::chrono::duration_cast<std::chrono::microseconds>(wall > Duration::zero() ? wall : wall_now());
  record_.frame = frame;
  record_.error_frame = error_frame;
  record_.direction = direction;
  tap_->record(record_);
}

std::optional<DeviceError> SocketCanBus::error() const {
  DeviceError error{DeviceErrorKind::disconnected, config_.interface, {}, state_.since};
  switch (state_.phase) {
    case SocketCanPhase::running:
      return std::nullopt;
    case SocketCanPhase::no_interface:
      error.what = std::string("no such CAN interface (") + std::strerror(closed_by_) + "): is the adapter plugged in?";
      break;
    case SocketCanPhase::link_down:
      error.what = "the link is down: ip link set " + config_.interface + " up type can bitrate ... restart-ms 100";
      break;
    case SocketCanPhase::bus_off:
      error.what = "bus-off: check the wiring, the two 120 ohm terminations and the bit rate";
      break;
  }
  return error;
}

}  // namespace hogline::hw
