#include "tests/src/live/notify_socket.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <sstream>
#include <system_error>

namespace hogline::live_test {

NotifySocket::NotifySocket(const std::string& path) : path_(path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof(address.sun_path)) throw std::system_error(ENAMETOOLONG, std::generic_category(), path);
  std::ranges::copy(path, address.sun_path);
  unlink(path.c_str());
  socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (socket_ < 0 || bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0)
    throw std::system_error(errno, std::generic_category(), path);
  thread_ = std::jthread([this](const std::stop_token& stop) { listen(stop); });
}

NotifySocket::~NotifySocket() {
  thread_.request_stop();
  thread_.join();
  close(socket_);
  unlink(path_.c_str());
}

void NotifySocket::listen(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    pollfd waiting{socket_, POLLIN, 0};
    if (poll(&waiting, 1, 20) != 1) continue;
    std::array<char, 512> bytes{};
    const auto got = recv(socket_, bytes.data(), bytes.size(), 0);
    if (got <= 0) continue;
    const Stamp at = std::chrono::steady_clock::now();
    std::istringstream words(std::string(bytes.data(), static_cast<std::size_t>(got)));
    const std::lock_guard lock(mutex_);
    for (std::string word; std::getline(words, word);) heard_.push_back({at, word});
  }
}

std::vector<Notification> NotifySocket::heard() const {
  const std::lock_guard lock(mutex_);
  return heard_;
}

long NotifySocket::count(const std::string& word, Stamp since) const {
  const std::lock_guard lock(mutex_);
  return std::ranges::count_if(heard_, [&](const Notification& n) { return n.at >= since && n.word == word; });
}

std::vector<std::string> NotifySocket::environment(Duration watchdog) const {
  const auto us = std::chrono::duration_cast<std::chrono::microseconds>(watchdog).count();
  return {"NOTIFY_SOCKET=" + path_, "WATCHDOG_USEC=" + std::to_string(us)};
}

}  // namespace hogline::live_test
