// Adapter: the operator's dead-man's switch as datagrams on a socket of this machine. Whoever holds it says so many
// times a second (SwitchHand); when he is gone, or his machine hangs, the state ages, and that stops the robot.
#pragma once

#include <string>

#include "hw/operator_switch.hpp"

namespace hogline::hw {

/// A datagram is the word "held" or "free"; anything else is passed over.
class LocalSwitch final : public OperatorSwitch {
 public:
  /// Makes the socket at `path`, for this user alone; one that a program left behind is replaced. Throws
  /// std::system_error, also where another program listens.
  explicit LocalSwitch(const std::string& path);
  ~LocalSwitch() override;
  LocalSwitch(const LocalSwitch&) = delete;
  LocalSwitch& operator=(const LocalSwitch&) = delete;

  void step(Stamp now) override;
  OperatorSwitchState state() const override { return state_; }

 private:
  std::string path_;
  int socket_ = -1;
  OperatorSwitchState state_;
};

/// The other end.
class SwitchHand {
 public:
  /// Throws std::system_error when no socket can be made.
  explicit SwitchHand(const std::string& path);
  ~SwitchHand();
  SwitchHand(const SwitchHand&) = delete;
  SwitchHand& operator=(const SwitchHand&) = delete;

  /// Says it once. False when nobody listens there.
  bool say(bool held);

 private:
  std::string path_;
  int socket_ = -1;
};

}  // namespace hogline::hw
