#include "hw/udp_can/udp_can_bus.hpp"

#include <arpa/inet.h>
#include <net/if.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>
#include <utility>

#include "hw/udp_can/can_datagram.hpp"

namespace hogline::hw {
namespace {

constexpr Duration reopen_period = std::chrono::milliseconds(100);
constexpr Duration oldest_frame = std::chrono::seconds(2);
constexpr int most_datagrams_a_call = 256;
constexpr int receive_buffer_bytes = 1 << 20;

Duration wall_now() {
  timespec wall{};
  clock_gettime(CLOCK_REALTIME, &wall);
  return std::chrono::seconds{wall.tv_sec} + std::chrono::nanoseconds{wall.tv_nsec};
}

// The kernel stamps arrivals by the wall clock. A stamp that can not be (the clock was set) is replaced by the present.
Stamp steady_of(Duration wall) {
  const Stamp now = std::chrono::steady_clock::now();
  const Duration age = wall_now() - wall;
  return age >= Duration::zero() && age < oldest_frame ? now - age : now;
}

std::optional<Duration> arrival_of(msghdr& message) {
  for (cmsghdr* part = CMSG_FIRSTHDR(&message); part != nullptr; part = CMSG_NXTHDR(&message, part)) {
    if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SCM_TIMESTAMPNS) continue;
    timespec stamp{};
    std::memcpy(&stamp, CMSG_DATA(part), sizeof(stamp));
    return std::chrono::seconds{stamp.tv_sec} + std::chrono::nanoseconds{stamp.tv_nsec};
  }
  return std::nullopt;
}

template <typename Value>
bool set(int socket, int level, int option, const Value& value) {
  return setsockopt(socket, level, option, &value, sizeof(value)) == 0;
}

}  // namespace

std::optional<std::string> config_error(const UdpCanConfig& config) {
  in_addr group{};
  if (inet_pton(AF_INET, config.group.c_str(), &group) != 1 || !IN_MULTICAST(ntohl(group.s_addr)))
    return "group: " + config.group + " is no IPv4 multicast address (224.0.0.0 to 239.255.255.255)";
  if (config.port < 1024) return "port: must be 1024 to 65535";
  return std::nullopt;
}

UdpCanBus::UdpCanBus(UdpCanConfig config, Stamp now) : config_(std::move(config)) {
  group_.sin_family = AF_INET;
  group_.sin_port = htons(config_.port);
  inet_pton(AF_INET, config_.group.c_str(), &group_.sin_addr);
  open(now);
}

UdpCanBus::~UdpCanBus() { close(); }

void UdpCanBus::close() {
  if (in_ >= 0) ::close(in_);
  if (out_ >= 0) ::close(out_);
  in_ = out_ = -1;
}

void UdpCanBus::open(Stamp now) {
  next_open_ = now + reopen_period;
  const int in = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const int out = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (in >= 0 && out >= 0 && set_up(in, out)) {
    in_ = in;
    out_ = out;
    return;
  }
  if (problem_.empty()) since_ = now;
  problem_ = std::strerror(errno);
  if (in >= 0) ::close(in);
  if (out >= 0) ::close(out);
}

// One socket hears the group on that interface alone, another speaks: the port it speaks from tells our own frames.
bool UdpCanBus::set_up(int in, int out) {
  ip_mreqn membership{};
  membership.imr_multiaddr = group_.sin_addr;
  membership.imr_ifindex = static_cast<int>(if_nametoindex(config_.interface.c_str()));
  if (membership.imr_ifindex == 0) return false;
  const int time_to_live = config_.interface == "lo" ? 0 : 1;
  if (!set(in, SOL_SOCKET, SO_REUSEADDR, 1) || !set(in, SOL_SOCKET, SO_TIMESTAMPNS, 1) ||
      !set(in, IPPROTO_IP, IP_MULTICAST_ALL, 0)) {
    return false;
  }
  set(in, SOL_SOCKET, SO_RCVBUF, receive_buffer_bytes);
  if (bind(in, reinterpret_cast<const sockaddr*>(&group_), sizeof(group_)) != 0) return false;
  if (!set(in, IPPROTO_IP, IP_ADD_MEMBERSHIP, membership)) return false;
  if (!set(out, IPPROTO_IP, IP_MULTICAST_IF, membership) || !set(out, IPPROTO_IP, IP_MULTICAST_TTL, time_to_live) ||
      !set(out, IPPROTO_IP, IP_MULTICAST_LOOP, 1)) {
    return false;
  }
  sockaddr_in own{};
  own.sin_family = AF_INET;
  socklen_t length = sizeof(own);
  if (bind(out, reinterpret_cast<const sockaddr*>(&own), length) != 0) return false;
  if (getsockname(out, reinterpret_cast<sockaddr*>(&own), &length) != 0) return false;
  own_port_ = own.sin_port;
  return true;
}

void UdpCanBus::step(Stamp now) {
  if (!up() && now >= next_open_) open(now);
}

CanSendResult UdpCanBus::send(const CanFrame& frame) {
  if (!up()) {
    ++counters_.refused;
    return CanSendResult::bus_down;
  }
  const std::vector<std::uint8_t> bytes = pack_can_frame(frame, seconds(wall_now()));
  const auto sent = sendto(out_, bytes.data(), bytes.size(), MSG_NOSIGNAL, reinterpret_cast<const sockaddr*>(&group_),
                           sizeof(group_));
  if (sent == static_cast<ssize_t>(bytes.size())) {
    ++counters_.sent;
    return CanSendResult::sent;
  }
  ++counters_.refused;
  return errno == EAGAIN || errno == ENOBUFS ? CanSendResult::would_block : CanSendResult::bus_down;
}

std::optional<StampedCanFrame> UdpCanBus::receive() {
  for (int i = 0; i < most_datagrams_a_call && up(); ++i) {
    std::array<std::uint8_t, 2048> bytes;
    alignas(cmsghdr) std::array<char, 128> ancillary;
    sockaddr_in sender{};
    iovec into{bytes.data(), bytes.size()};
    msghdr message{};
    message.msg_name = &sender;
    message.msg_namelen = sizeof(sender);
    message.msg_iov = &into;
    message.msg_iovlen = 1;
    message.msg_control = ancillary.data();
    message.msg_controllen = ancillary.size();
    const auto got = recvmsg(in_, &message, 0);
    if (got < 0) return std::nullopt;
    if (sender.sin_port == own_port_) continue;
    const auto frame = unpack_can_frame(std::span(bytes).first(static_cast<std::size_t>(got)));
    if (!frame) {
      ++counters_.malformed;
      continue;
    }
    ++counters_.received;
    const auto arrival = arrival_of(message);
    return StampedCanFrame{*frame, arrival ? steady_of(*arrival) : std::chrono::steady_clock::now()};
  }
  return std::nullopt;
}

std::optional<DeviceError> UdpCanBus::error() const {
  if (up()) return std::nullopt;
  return DeviceError{DeviceErrorKind::disconnected, "CAN over UDP " + config_.group,
                     "on interface " + config_.interface + ": " + problem_, since_};
}

}  // namespace hogline::hw
