#include "hw/socketcan/bcm_cyclic.hpp"

#include <linux/can.h>
#include <linux/can/bcm.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <utility>

namespace hogline::hw {
namespace {

constexpr Duration reopen_period = std::chrono::milliseconds{100};

canid_t raw_id(const CanFrame& frame) {
  return frame.id | (frame.extended ? CAN_EFF_FLAG : 0U) | (frame.remote ? CAN_RTR_FLAG : 0U);
}

}  // namespace

BcmCyclic::BcmCyclic(std::string interface, const CanFrame& frame, Duration period, Stamp now)
    : interface_(std::move(interface)), frame_(frame), period_(period) {
  assert(period >= std::chrono::microseconds{1});
  open(now);
}

BcmCyclic::~BcmCyclic() { close(0); }

void BcmCyclic::open(Stamp now) {
  next_open_ = now + reopen_period;
  index_ = static_cast<int>(if_nametoindex(interface_.c_str()));
  if (index_ == 0) return close(ENODEV);
  fd_ = ::socket(PF_CAN, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_BCM);
  if (fd_ < 0) return close(errno);
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = index_;
  if (::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) return close(errno);
  if (!paused_ && !set_up_timer()) return close(errno);
  error_ = 0;
}

void BcmCyclic::close(int reason) {
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
  error_ = reason;
}

// An interface that was removed, and perhaps made again under its name, has another index; the socket's timer is gone.
void BcmCyclic::step(Stamp now) {
  if (fd_ >= 0 && static_cast<int>(if_nametoindex(interface_.c_str())) != index_) close(ENODEV);
  if (fd_ < 0 && now >= next_open_) open(now);
}

bool BcmCyclic::set_up_timer() {
  const auto period_us = std::chrono::duration_cast<std::chrono::microseconds>(period_).count();
  bcm_msg_head head{};
  head.opcode = TX_SETUP;
  head.flags = SETTIMER | STARTTIMER;
  head.ival2.tv_sec = period_us / 1'000'000;
  head.ival2.tv_usec = period_us % 1'000'000;
  head.can_id = raw_id(frame_);
  head.nframes = 1;
  can_frame frame{};
  frame.can_id = raw_id(frame_);
  frame.can_dlc = frame_.length;
  std::copy_n(frame_.data.begin(), frame_.length, frame.data);

  // The head's last member is an array without a length: the frames follow it.
  std::array<std::byte, sizeof head + sizeof frame> message;
  std::memcpy(message.data(), &head, sizeof head);
  std::memcpy(message.data() + sizeof head, &frame, sizeof frame);
  return ::write(fd_, message.data(), message.size()) == static_cast<ssize_t>(message.size());
}

bool BcmCyclic::delete_timer() {
  bcm_msg_head head{};
  head.opcode = TX_DELETE;
  head.can_id = raw_id(frame_);
  return ::write(fd_, &head, sizeof head) == sizeof head;
}

void BcmCyclic::pause() {
  if (std::exchange(paused_, true) || fd_ < 0) return;
  if (!delete_timer()) close(errno);
}

void BcmCyclic::resume() {
  if (!std::exchange(paused_, false) || fd_ < 0) return;
  if (!set_up_timer()) close(errno);
}

}  // namespace hogline::hw
