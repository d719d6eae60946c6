#include "tests/hil/can_node.hpp"

#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace hogline::hil {

CanNode::CanNode(const std::string& interface) {
  fd_ = socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK, CAN_RAW);
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(if_nametoindex(interface.c_str()));
  const can_err_mask_t all_errors = CAN_ERR_MASK;
  const int fd_frames = 1;
  const int buffer = 1 << 20;
  setsockopt(fd_, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &all_errors, sizeof all_errors);
  setsockopt(fd_, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &fd_frames, sizeof fd_frames);
  setsockopt(fd_, SOL_SOCKET, SO_RCVBUFFORCE, &buffer, sizeof buffer);
  if (address.can_ifindex == 0 || bind(fd_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
    throw std::system_error(errno, std::generic_category(), interface);
}

CanNode::~CanNode() { close(fd_); }

void CanNode::write(const void* frame, std::size_t size) {
  bool may_have_been_down = true;  // of which the socket tells once, even if it is up again
  while (::write(fd_, frame, size) != static_cast<ssize_t>(size)) {
    const bool later =
        errno == EAGAIN || errno == ENOBUFS || (errno == ENETDOWN && std::exchange(may_have_been_down, false));
    if (!later) throw std::system_error(errno, std::generic_category(), "write to CAN");
    pollfd room{fd_, POLLOUT, 0};
    poll(&room, 1, 10);
  }
}

void CanNode::send(canid_t id, const std::vector<unsigned char>& data) {
  can_frame frame{};
  frame.can_id = id;
  frame.can_dlc = static_cast<unsigned char>(data.size());
  std::copy(data.begin(), data.end(), frame.data);
  write(&frame, sizeof frame);
}

void CanNode::send_fd(canid_t id, const std::vector<unsigned char>& data) {
  canfd_frame frame{};
  frame.can_id = id;
  frame.len = static_cast<unsigned char>(data.size());
  std::copy(data.begin(), data.end(), frame.data);
  write(&frame, sizeof frame);
}

std::optional<can_frame> CanNode::hear() {
  can_frame frame{};
  ssize_t size = 0;
  do {
    size = read(fd_, &frame, sizeof frame);
  } while (size < 0 && errno == ENETDOWN);  // told once after each time that the link was down
  return size == sizeof frame ? std::optional(frame) : std::nullopt;
}

std::vector<can_frame> CanNode::hear(std::size_t count) {
  std::vector<can_frame> heard;
  for (int patience = 2000; heard.size() < count && patience > 0; --patience) {
    pollfd news{fd_, POLLIN, 0};
    poll(&news, 1, 10);
    while (const auto frame = hear()) heard.push_back(*frame);
  }
  return heard;
}

std::vector<can_frame> CanNode::hear_all() {
  std::vector<can_frame> heard;
  while (const auto frame = hear()) heard.push_back(*frame);
  return heard;
}

}  // namespace hogline::hil
