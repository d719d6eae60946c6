// Another node on the bus, by plain system calls: shares nothing with the adapter under test.
#pragma once

#include <linux/can.h>

#include <optional>
#include <string>
#include <vector>

namespace hogline::hil {

/// A raw socket on one interface that sends what it is told and hears everything but itself, error frames included.
class CanNode {
 public:
  /// Throws std::system_error if the interface is missing.
  explicit CanNode(const std::string& interface);
  ~CanNode();
  CanNode(const CanNode&) = delete;
  CanNode& operator=(const CanNode&) = delete;

  /// The identifier word with its flags (CAN_EFF_FLAG, CAN_RTR_FLAG, CAN_ERR_FLAG). Throws if it can not be sent.
  void send(canid_t id, const std::vector<unsigned char>& data = {});
  /// A CAN FD frame.
  void send_fd(canid_t id, const std::vector<unsigned char>& data);

  /// What has arrived and was not heard yet; does not wait.
  std::optional<can_frame> hear();
  std::vector<can_frame> hear_all();
  /// Waits until this many frames have arrived, or 20 s; gives all of them, more if there are more.
  std::vector<can_frame> hear(std::size_t count);

 private:
  void write(const void* frame, std::size_t size);
  int fd_ = -1;
};

}  // namespace hogline::hil
