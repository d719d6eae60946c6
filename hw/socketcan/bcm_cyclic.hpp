// A cyclic frame sent by the kernel's own timer (SocketCAN's broadcast manager, CAN_BCM): SYNC without our jitter.
#pragma once

#include <cstdint>
#include <string>

#include "hw/can_bus.hpp"

namespace hogline::hw {

/// The kernel sends the frame for as long as this object lives, whatever becomes of the thread that made it: nothing
/// that must stop with that thread (a heartbeat, a set-point) may be sent this way. It ends with the process, by a
/// signal too.
///
/// A link that goes down and up again does not end it. An interface that is removed does; step() starts it again when
/// one of this name is back. Used by one thread; no call blocks.
class BcmCyclic {
 public:
  /// Starts at once if the interface is there. Precondition: period > 0; whole microseconds.
  BcmCyclic(std::string interface, const CanFrame& frame, Duration period, Stamp now);
  ~BcmCyclic();
  BcmCyclic(const BcmCyclic&) = delete;
  BcmCyclic& operator=(const BcmCyclic&) = delete;

  /// Looks after the socket, every control period.
  void step(Stamp now);
  /// Ends and begins the sending. While the drives are not to act on old set-points they need no SYNC.
  void pause();
  void resume();

  bool running() const { return fd_ >= 0 && !paused_; }
  int error() const { return error_; }  ///< errno of the last attempt to start; 0: it runs

 private:
  void open(Stamp now);
  void close(int reason);
  bool set_up_timer();
  bool delete_timer();

  std::string interface_;
  CanFrame frame_;
  Duration period_;
  int fd_ = -1;
  int index_ = 0;
  int error_ = 0;
  bool paused_ = false;
  Stamp next_open_{};
};

}  // namespace hogline::hw
