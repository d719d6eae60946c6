#include "hw/digital_curling/client_port.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <stdexcept>
#include <system_error>

namespace hogline::hw::digital_curling {
namespace {

sockaddr_in socket_address(const std::string& address, int port) {
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(static_cast<std::uint16_t>(port));
  if (inet_pton(AF_INET, address.c_str(), &place.sin_addr) != 1 || port < 0 || port > 65535)
    throw std::invalid_argument("'" + address + ":" + std::to_string(port) + "' is no IPv4 address and port");
  return place;
}

std::string in_words(const sockaddr_in& place) {
  std::array<char, INET_ADDRSTRLEN> text{};
  inet_ntop(AF_INET, &place.sin_addr, text.data(), text.size());
  return std::string(text.data()) + ":" + std::to_string(ntohs(place.sin_port));
}

std::string words_for(int error) { return std::generic_category().message(error); }

bool would_block(int error) { return error == EAGAIN || error == EWOULDBLOCK || error == EINTR; }

}  // namespace

ClientPort::ClientPort(const std::string& address, int port) : address_(address) {
  sockaddr_in place = socket_address(address, port);
  listening_ = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const int yes = 1;
  socklen_t size = sizeof place;
  auto* const raw = reinterpret_cast<sockaddr*>(&place);
  if (listening_ < 0 || setsockopt(listening_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) != 0 ||
      bind(listening_, raw, sizeof place) != 0 || listen(listening_, 4) != 0 ||
      getsockname(listening_, raw, &size) != 0) {
    const int error = errno;
    if (listening_ >= 0) ::close(listening_);
    throw std::system_error(error, std::generic_category(), address + ":" + std::to_string(port));
  }
  port_ = ntohs(place.sin_port);
}

ClientPort::~ClientPort() {
  hang_up();
  ::close(listening_);
}

std::string ClientPort::where() const { return address_ + ":" + std::to_string(port_); }

void ClientPort::hang_up() {
  if (client_ >= 0) ::close(client_);
  client_ = -1;
}

ClientPort::Calls ClientPort::accept() {
  Calls calls;
  for (;;) {
    sockaddr_in caller{};
    socklen_t size = sizeof caller;
    const int descriptor =
        accept4(listening_, reinterpret_cast<sockaddr*>(&caller), &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (descriptor < 0) return calls;
    if (had_client_) {
      ::close(descriptor);
      calls.turned_away = in_words(caller);
      continue;
    }
    const int yes = 1;
    setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    client_ = descriptor;
    had_client_ = calls.connected = true;
  }
}

ClientPort::Heard ClientPort::hear() {
  if (client_ < 0) return {};
  std::array<char, 16384> buffer{};
  const auto got = recv(client_, buffer.data(), buffer.size(), 0);
  if (got > 0) return {std::string(buffer.data(), static_cast<std::size_t>(got)), {}};
  if (got < 0 && would_block(errno)) return {};
  const std::string why = got == 0 ? "hung up" : words_for(errno);
  hang_up();
  return {{}, why};
}

std::optional<std::string> ClientPort::send(std::string& bytes) {
  while (client_ >= 0 && !bytes.empty()) {
    const auto sent = ::send(client_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent < 0 && would_block(errno)) return std::nullopt;
    if (sent < 0) {
      const std::string why = words_for(errno);
      hang_up();
      return why;
    }
    bytes.erase(0, static_cast<std::size_t>(sent));
  }
  return std::nullopt;
}

}  // namespace hogline::hw::digital_curling
