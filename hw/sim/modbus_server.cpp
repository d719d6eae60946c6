#include "hw/sim/modbus_server.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <pty.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <vector>

namespace hogline::hw::sim {

namespace {

// An RTU frame ends with a silence of 3.5 characters (1.75 ms above 19200 baud); a pseudo terminal has no baud rate.
constexpr int silence_ms = 5;

struct Line {
  int descriptor = -1;
  ModbusStationLine state;
};

[[noreturn]] void fail(const char* doing) { throw std::system_error(errno, std::generic_category(), doing); }

void send_all(int descriptor, std::span<const std::uint8_t> bytes, ModbusWire wire) {
  while (!bytes.empty()) {
    const auto sent = wire == ModbusWire::tcp ? send(descriptor, bytes.data(), bytes.size(), MSG_NOSIGNAL)
                                              : write(descriptor, bytes.data(), bytes.size());
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return;  // the other end is gone
    bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
}

void reset_connection(int socket) {
  const linger at_once{1, 0};
  setsockopt(socket, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
}

}  // namespace

struct ModbusServer::Impl {
  explicit Impl(ModbusStation& answering) : station(answering) {}

  ModbusStation& station;  ///< under the devices' mutex
  int listener = -1;
  int wake = -1;
  int terminal = -1;        ///< our end of the pseudo terminal
  int terminal_other = -1;  ///< held open, so that a client may come and go
  std::vector<Line> lines;

  void serve(std::mutex& devices);
  void accept_connection();
  bool receive(Line& line, std::mutex& devices);
  void close_all();
};

ModbusServer::ModbusServer(ModbusStation& station, std::mutex& devices, int port)
    : devices_(devices), impl_(std::make_unique<Impl>(station)), port_(port) {
  start();
}

ModbusServer::~ModbusServer() { stop(); }

void ModbusServer::start() {
  impl_->listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (impl_->listener < 0) fail("socket");
  const int yes = 1;
  setsockopt(impl_->listener, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port_));
  socklen_t length = sizeof address;
  if (bind(impl_->listener, reinterpret_cast<sockaddr*>(&address), length) != 0) fail("binding 127.0.0.1");
  if (listen(impl_->listener, 8) != 0) fail("listening on 127.0.0.1");
  getsockname(impl_->listener, reinterpret_cast<sockaddr*>(&address), &length);
  port_ = ntohs(address.sin_port);
  impl_->wake = eventfd(0, EFD_CLOEXEC);
  if (impl_->wake < 0) fail("eventfd");
  if (serves_rtu_) open_terminal();
  thread_ = std::thread([this] { impl_->serve(devices_); });
}

void ModbusServer::open_terminal() {
  std::array<char, 128> path{};
  if (openpty(&impl_->terminal, &impl_->terminal_other, nullptr, nullptr, nullptr) != 0 ||
      ttyname_r(impl_->terminal_other, path.data(), path.size()) != 0) {
    fail("opening a pseudo terminal");
  }
  termios settings{};
  tcgetattr(impl_->terminal_other, &settings);
  cfmakeraw(&settings);
  tcsetattr(impl_->terminal_other, TCSANOW, &settings);
  impl_->lines.push_back({.descriptor = impl_->terminal, .state = {.wire = ModbusWire::rtu}});
  rtu_path_ = path.data();
}

std::string ModbusServer::serve_rtu() {
  if (serves_rtu_) return rtu_path_;
  stop();
  serves_rtu_ = true;
  start();
  return rtu_path_;
}

void ModbusServer::stop() {
  if (!thread_.joinable()) return;
  eventfd_write(impl_->wake, 1);
  thread_.join();
  impl_->close_all();
}

void ModbusServer::Impl::close_all() {
  for (const auto& line : lines) close(line.descriptor);
  lines.clear();
  if (terminal_other >= 0) close(terminal_other);
  terminal = terminal_other = -1;
  close(listener);
  close(wake);
}

void ModbusServer::restart() {
  if (!thread_.joinable()) start();
}

void ModbusServer::Impl::serve(std::mutex& devices) {
  for (;;) {
    std::vector<pollfd> waiting{{wake, POLLIN, 0}, {listener, POLLIN, 0}};
    bool frame_under_way = false;
    for (const auto& line : lines) {
      waiting.push_back({line.state.forgotten ? -1 : line.descriptor, POLLIN, 0});
      frame_under_way = frame_under_way || (line.state.wire == ModbusWire::rtu && !line.state.received.empty());
    }
    const int ready = poll(waiting.data(), waiting.size(), frame_under_way ? silence_ms : -1);
    if (ready < 0) continue;
    if (ready == 0) {
      for (auto& line : lines) line.state.received.clear();
    }
    if (waiting[0].revents != 0) return;
    for (std::size_t i = lines.size(); i-- > 0;) {
      if (waiting[i + 2].revents == 0 || receive(lines[i], devices)) continue;
      close(lines[i].descriptor);
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(i));
    }
    if (waiting[1].revents != 0) accept_connection();
  }
}

void ModbusServer::Impl::accept_connection() {
  const int socket = accept4(listener, nullptr, nullptr, SOCK_CLOEXEC);
  if (socket < 0) return;
  const int yes = 1;
  setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  lines.push_back({.descriptor = socket, .state = {.wire = ModbusWire::tcp}});
}

// Whatever has arrived. False when the line is to be closed.
bool ModbusServer::Impl::receive(Line& line, std::mutex& devices) {
  std::array<std::uint8_t, 512> buffer{};
  const auto got = read(line.descriptor, buffer.data(), buffer.size());
  if (got < 0 && errno == EINTR) return true;
  if (got <= 0) return false;
  const std::lock_guard lock(devices);
  const ModbusReply reply = station.take(line.state, std::span(buffer).first(static_cast<std::size_t>(got)));
  send_all(line.descriptor, reply.bytes, line.state.wire);
  if (reply.resets) reset_connection(line.descriptor);
  return !reply.resets;
}

}  // namespace hogline::hw::sim
