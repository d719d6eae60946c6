// A CAN bus of the Linux kernel (SocketCAN, CAN_RAW). See doc/socketcan.md for what each fault does.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hw/device_status.hpp"
#include "hw/socketcan/can_error_frame.hpp"
#include "hw/socketcan/can_socket.hpp"
#include "hw/socketcan/can_tap.hpp"
#include "hw/socketcan/sent_frames.hpp"

namespace hogline::hw {

struct SocketCanConfig {
  std::string interface = "can0";
  /// What receive() gives. Empty: every classic data frame, remote frames included.
  std::vector<CanFilter> receive{};
  /// Identifiers that only this program may send (RPDOs, SYNC, NMT, SDO requests). Needed beside `receive` so that the
  /// kernel confirms them. The same frames from anybody else are counted as foreign, and receive() gives them too.
  std::vector<CanFilter> own{};
  /// Identifiers of which only one frame may be on its way: set-points and SYNC. While an earlier one has not been seen
  /// on the bus the next is refused, so that a bus that takes nothing holds one old set-point and not ten. Needs
  /// confirmations: part of `own` where `receive` is given.
  std::vector<CanFilter> one_at_a_time{};
  Duration reopen_period = std::chrono::milliseconds(100);    ///< between two attempts to find the interface
  Duration confirm_deadline = std::chrono::milliseconds(50);  ///< a frame not seen on the bus by then is unconfirmed
};

enum class SocketCanPhase {
  no_interface,  ///< no interface of this name, or no right to it: tried again by name every reopen_period
  link_down,     ///< the interface is there and is down, or has no carrier
  bus_off,       ///< the controller has left the bus; its driver must restart it (restart-ms, or by hand)
  running,
};

const char* to_string(SocketCanPhase phase);

/// Counters since construction.
struct SocketCanCounters {
  std::uint64_t sent = 0;         ///< handed to the kernel
  std::uint64_t confirmed = 0;    ///< of these, seen on the bus
  std::uint64_t unconfirmed = 0;  ///< of these, not seen within the deadline or before an outage
  std::uint64_t would_block = 0;  ///< dropped here: no room, or the one before is still on its way
  std::uint64_t refused = 0;      ///< dropped here: the bus was down
  std::uint64_t received = 0;
  std::uint64_t foreign = 0;       ///< our own identifiers sent by somebody else: a second master
  std::uint64_t kernel_drops = 0;  ///< received frames lost because they were not read in time
  std::uint64_t error_frames = 0;
  std::uint64_t bus_offs = 0;
  std::uint64_t outages = 0;          ///< times that `running` was left
  std::uint64_t opened = 0;           ///< times that the interface was found and opened
  std::uint64_t stamps_replaced = 0;  ///< frames without a usable kernel stamp, stamped when read
};

struct SocketCanState {
  SocketCanPhase phase = SocketCanPhase::no_interface;
  Stamp since{};  ///< of the phase
  CanControllerState controller = CanControllerState::active;
  CanErrorCounters error_counters;         ///< as last told by an error frame
  std::optional<Stamp> unconfirmed_since;  ///< when the oldest frame on its way was sent
  SocketCanCounters counters;
};

/// Used by one thread. Nothing blocks. step() runs the connection: it is called every control period, before receive()
/// and send(). Every outage is visible to up() for at least one period, however short it was.
class SocketCanBus final : public CanBus {
 public:
  /// Tries to open at once. A missing interface is a state, not an error: it may come.
  SocketCanBus(SocketCanConfig config, Stamp now);

  void step(Stamp now);
  CanSendResult send(const CanFrame& frame) override;
  std::optional<StampedCanFrame> receive() override;
  bool up() const override { return state_.phase == SocketCanPhase::running; }
  bool error_passive() const override { return state_.controller == CanControllerState::passive; }

  const SocketCanState& state() const { return state_; }
  /// Why the bus is down and what to check, or nothing. Not latched.
  std::optional<DeviceError> error() const;
  /// Every frame and error frame seen on the bus goes to this tap, which must outlive the bus. Null: none.
  void set_tap(CanTap* tap) { tap_ = tap; }

 private:
  void open(Stamp now);
  void close(int reason);
  void enter(SocketCanPhase phase);
  void watch_link();
  void take_error_frames();
  void on_error_frame(const CanErrorFrame& error);
  void on_socket_error(int error);
  void on_own_frame(const CanMessage& message);
  void expire_unconfirmed();
  void count_drops(const CanMessage& message);
  Stamp stamp_of(const CanMessage& message);
  void tell_tap(const CanFrame& frame, Duration wall, CanDirection direction, bool error_frame);

  SocketCanConfig config_;
  std::vector<CanFilter> kernel_filters_;
  CanTap* tap_ = nullptr;
  CandumpRecord record_;  // reused: its name is not copied for each frame

  std::optional<CanSocket> frames_;
  std::optional<CanSocket> errors_;  // of its own, so that send() can look for a bus-off without reading data
  SocketCanState state_;
  SentFrames sent_;
  Stamp now_;
  Stamp next_open_{};
  int closed_by_ = 0;
  std::uint32_t drops_seen_ = 0;
  bool recovered_ = false;      // to be taken up by the next step
  bool link_was_down_ = false;  // since the bus-off
};

}  // namespace hogline::hw
