// One non-blocking raw CAN socket: system calls and nothing else.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "hw/socketcan/can_filter.hpp"
#include "vision/percepts/stamp.hpp"

namespace hogline::hw {

/// What a socket asks the kernel for.
struct CanSocketOptions {
  std::span<const CanFilter> filters;  ///< data frames wanted; empty: none if only_errors, else all
  bool only_errors = false;            ///< error frames instead of data frames
};

enum class CanMessageKind {
  data,          ///< of another node, or of another program on this machine
  confirmation,  ///< of this very socket: the driver has sent it
  error,         ///< an error frame: frame.id are its class bits
};

struct CanMessage {
  CanMessageKind kind = CanMessageKind::data;
  CanFrame frame;
  Duration wall{};                     ///< the kernel's receive time since the Unix epoch; 0 if it gave none
  std::optional<std::uint32_t> drops;  ///< lost in this socket's full buffer since it was opened; absent while 0
};

/// Every call returns at once. Errors are errno values, 0 is success.
class CanSocket {
 public:
  struct Opened;
  /// Opens and binds to the interface of this name. ENODEV: there is none. EAFNOSUPPORT: this kernel has no SocketCAN.
  static Opened open(const std::string& interface, const CanSocketOptions& options);

  CanSocket(CanSocket&& other) noexcept;
  CanSocket& operator=(CanSocket&& other) noexcept;
  ~CanSocket();

  /// EAGAIN and ENOBUFS: no room; the frame is not queued.
  int send(const CanFrame& frame);

  struct Received {
    std::optional<CanMessage> message;
    int error = 0;  ///< EAGAIN: nothing there
  };
  Received receive();

  /// Takes the error that waits on the socket: ENETDOWN, ENODEV.
  int pending_error();

  /// True if the interface of this name is up and has its carrier. In `error` ENODEV if it is gone.
  bool link_up(const std::string& interface, int& error) const;

 private:
  explicit CanSocket(int fd) : fd_(fd) {}
  int fd_ = -1;
};

struct CanSocket::Opened {
  std::optional<CanSocket> socket;
  int error = 0;
};

}  // namespace hogline::hw
