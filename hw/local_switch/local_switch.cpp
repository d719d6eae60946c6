#include "hw/local_switch/local_switch.hpp"

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string_view>
#include <system_error>
#include <utility>

namespace hogline::hw {
namespace {

constexpr std::string_view held_word = "held";
constexpr std::string_view free_word = "free";
constexpr int most_datagrams_a_step = 64;

sockaddr_un address_of(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof(address.sun_path)) {
    throw std::system_error(ENAMETOOLONG, std::generic_category(), "operator's socket " + path);
  }
  std::ranges::copy(path, address.sun_path);
  return address;
}

int open_socket(const std::string& path) {
  const int socket = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket < 0) throw std::system_error(errno, std::generic_category(), "operator's socket " + path);
  return socket;
}

// What a program that was killed left behind; never anything but a socket, nor one at which a living program listens.
void remove_old(const std::string& path, const sockaddr_un& address) {
  struct stat status {};
  if (lstat(path.c_str(), &status) != 0 || !S_ISSOCK(status.st_mode)) return;
  const int probe = open_socket(path);
  const bool lives = connect(probe, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  close(probe);
  if (lives) {
    throw std::system_error(EADDRINUSE, std::generic_category(),
                            "operator's socket " + path + ": another program listens there; end it first");
  }
  unlink(path.c_str());
}

/// Closed when the rest fails.
struct OpenSocket {
  explicit OpenSocket(const std::string& path) : descriptor(open_socket(path)) {}
  ~OpenSocket() {
    if (descriptor >= 0) close(descriptor);
  }
  OpenSocket(const OpenSocket&) = delete;
  OpenSocket& operator=(const OpenSocket&) = delete;
  int descriptor;
};

}  // namespace

LocalSwitch::LocalSwitch(const std::string& path) : path_(path) {
  OpenSocket opened(path);
  const sockaddr_un address = address_of(path);
  remove_old(path, address);
  const mode_t before = umask(0177);
  const int bound = bind(opened.descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof(address));
  const int error = errno;
  umask(before);
  if (bound != 0) throw std::system_error(error, std::generic_category(), "operator's socket " + path);
  socket_ = std::exchange(opened.descriptor, -1);
}

LocalSwitch::~LocalSwitch() {
  close(socket_);
  unlink(path_.c_str());
}

void LocalSwitch::step(Stamp now) {
  std::array<char, 16> word{};
  for (int i = 0; i < most_datagrams_a_step; ++i) {
    const auto got = recv(socket_, word.data(), word.size(), 0);
    if (got < 0) return;
    const std::string_view said(word.data(), static_cast<std::size_t>(got));
    if (said == held_word) state_ = {.held = true, .stamp = now};
    if (said == free_word) state_ = {.held = false, .stamp = now};
  }
}

SwitchHand::SwitchHand(const std::string& path) : path_(path), socket_(open_socket(path)) {}

SwitchHand::~SwitchHand() { close(socket_); }

bool SwitchHand::say(bool held) {
  const sockaddr_un address = address_of(path_);
  const std::string_view word = held ? held_word : free_word;
  return sendto(socket_, word.data(), word.size(), MSG_NOSIGNAL, reinterpret_cast<const sockaddr*>(&address),
                sizeof(address)) == static_cast<ssize_t>(word.size());
}

}  // namespace hogline::hw
