#include "hw/socketcan/can_socket.hpp"

#include <linux/can.h>
#include <linux/can/raw.h>
#include <linux/errqueue.h>
#include <linux/net_tstamp.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

namespace hogline::hw {

namespace {

template <typename Value>
bool set_option(int fd, int level, int name, const Value& value) {
  return setsockopt(fd, level, name, &value, sizeof value) == 0;
}

// The identifier's length and the remote flag are part of what is compared: without them in the mask an extended or
// remote frame with the same low bits passes.
bool set_filters(int fd, std::span<const CanFilter> filters) {
  std::vector<can_filter> raw;
  for (const CanFilter& filter : filters) {
    const canid_t length = filter.extended ? CAN_EFF_FLAG : 0U;
    raw.push_back({filter.id | length, filter.mask | CAN_EFF_FLAG | CAN_RTR_FLAG});
  }
  const auto bytes = static_cast<socklen_t>(raw.size() * sizeof(can_filter));
  return setsockopt(fd, SOL_CAN_RAW, CAN_RAW_FILTER, raw.data(), bytes) == 0;
}

// SO_SNDBUF 0 becomes the kernel's minimum of a few frames. With the default buffer write() fails with ENOBUFS while
// poll says that there is room, and a stopped bus collects a second of stale commands.
bool set_options(int fd, const CanSocketOptions& options) {
  const bool restrict_data = options.only_errors || !options.filters.empty();
  if (restrict_data && !set_filters(fd, options.filters)) return false;
  const can_err_mask_t errors = options.only_errors ? CAN_ERR_MASK : 0U;
  return set_option(fd, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, errors) &&
         set_option(fd, SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, options.only_errors ? 0 : 1) &&
         set_option(fd, SOL_SOCKET, SO_SNDBUF, 0) && set_option(fd, SOL_SOCKET, SO_RXQ_OVFL, 1) &&
         set_option(fd, SOL_SOCKET, SO_TIMESTAMPING, SOF_TIMESTAMPING_RX_SOFTWARE | SOF_TIMESTAMPING_SOFTWARE);
}

can_frame to_raw(const CanFrame& frame) {
  can_frame raw{};
  raw.can_id = frame.id | (frame.extended ? CAN_EFF_FLAG : 0U) | (frame.remote ? CAN_RTR_FLAG : 0U);
  raw.can_dlc = frame.length;
  if (!frame.remote) std::copy_n(frame.data.begin(), frame.length, raw.data);
  return raw;
}

CanFrame from_raw(const can_frame& raw) {
  CanFrame frame;
  const bool error = (raw.can_id & CAN_ERR_FLAG) != 0;
  frame.extended = !error && (raw.can_id & CAN_EFF_FLAG);
  frame.remote = !error && (raw.can_id & CAN_RTR_FLAG);
  frame.id = raw.can_id & (error || frame.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
  frame.length = std::min<std::uint8_t>(raw.can_dlc, CAN_MAX_DLEN);
  if (!frame.remote) std::copy_n(raw.data, frame.length, frame.data.begin());
  return frame;
}

void read_control_messages(msghdr& header, CanMessage& message) {
  for (cmsghdr* c = CMSG_FIRSTHDR(&header); c != nullptr; c = CMSG_NXTHDR(&header, c)) {
    if (c->cmsg_level != SOL_SOCKET) continue;
    if (c->cmsg_type == SCM_TIMESTAMPING) {
      scm_timestamping stamps;
      std::memcpy(&stamps, CMSG_DATA(c), sizeof stamps);
      const timespec& software = stamps.ts[0];
      message.wall = std::chrono::seconds{software.tv_sec} + std::chrono::nanoseconds{software.tv_nsec};
    } else if (c->cmsg_type == SO_RXQ_OVFL) {
      std::uint32_t drops = 0;
      std::memcpy(&drops, CMSG_DATA(c), sizeof drops);
      message.drops = drops;
    }
  }
}

}  // namespace

CanSocket::Opened CanSocket::open(const std::string& interface, const CanSocketOptions& options) {
  const int fd = ::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
  if (fd < 0) return {std::nullopt, errno};
  CanSocket opened(fd);
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(if_nametoindex(interface.c_str()));
  if (address.can_ifindex == 0) return {std::nullopt, ENODEV};
  if (!set_options(fd, options)) return {std::nullopt, errno};
  if (::bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) return {std::nullopt, errno};
  return {std::move(opened), 0};
}

CanSocket::CanSocket(CanSocket&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}

CanSocket& CanSocket::operator=(CanSocket&& other) noexcept {
  std::swap(fd_, other.fd_);
  return *this;
}

CanSocket::~CanSocket() {
  if (fd_ >= 0) ::close(fd_);
}

int CanSocket::send(const CanFrame& frame) {
  assert(frame.length <= CAN_MAX_DLEN);
  const can_frame raw = to_raw(frame);
  return ::send(fd_, &raw, sizeof raw, MSG_DONTWAIT | MSG_NOSIGNAL) == sizeof raw ? 0 : errno;
}

CanSocket::Received CanSocket::receive() {
  can_frame raw{};
  iovec data{&raw, sizeof raw};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(scm_timestamping)) + CMSG_SPACE(sizeof(std::uint32_t))> control{};
  msghdr header{};
  header.msg_iov = &data;
  header.msg_iovlen = 1;
  header.msg_control = control.data();
  header.msg_controllen = control.size();
  if (::recvmsg(fd_, &header, MSG_DONTWAIT) < 0) return {std::nullopt, errno};

  CanMessage message;
  message.frame = from_raw(raw);
  if (raw.can_id & CAN_ERR_FLAG)
    message.kind = CanMessageKind::error;
  else if (header.msg_flags & MSG_CONFIRM)
    message.kind = CanMessageKind::confirmation;
  read_control_messages(header, message);
  return {message, 0};
}

int CanSocket::pending_error() {
  int error = 0;
  socklen_t size = sizeof error;
  return getsockopt(fd_, SOL_SOCKET, SO_ERROR, &error, &size) == 0 ? error : errno;
}

bool CanSocket::link_up(const std::string& interface, int& error) const {
  ifreq request{};
  interface.copy(request.ifr_name, IFNAMSIZ - 1);
  error = ioctl(fd_, SIOCGIFFLAGS, &request) == 0 ? 0 : errno;
  return error == 0 && (request.ifr_flags & IFF_UP) && (request.ifr_flags & IFF_RUNNING);
}

}  // namespace hogline::hw
