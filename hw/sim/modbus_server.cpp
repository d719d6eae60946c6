#include "hw/sim/modbus_server.hpp"

#include <arpa/inet.h>
#include <modbus/modbus.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

namespace hogline::hw::sim {

namespace {

struct FreeContext {
  void operator()(modbus_t* context) const { modbus_free(context); }
};
struct FreeMapping {
  void operator()(modbus_mapping_t* mapping) const { modbus_mapping_free(mapping); }
};

struct MappedUnit {
  ModbusUnit unit;
  std::unique_ptr<modbus_mapping_t, FreeMapping> mapping;
};

using Request = std::vector<std::uint8_t>;

struct Connection {
  int socket = -1;
  Request unanswered;  ///< what a late server still owes
};

// Modbus TCP: seven bytes of header, the last of them the unit; then function, address, count or value.
constexpr std::size_t unit_at = 6;
constexpr std::size_t function_at = 7;
constexpr std::size_t address_at = 8;
constexpr std::size_t count_at = 10;
constexpr std::size_t many_values_at = 13;

constexpr int read_holding = 3;
constexpr int read_input = 4;
constexpr int write_one = 6;
constexpr int write_many = 16;
constexpr int illegal_function = 1;
constexpr int illegal_value = 3;
constexpr int no_such_unit = 11;

int word_at(const Request& request, std::size_t place) { return request[place] << 8 | request[place + 1]; }

[[noreturn]] void fail(const char* doing) { throw std::system_error(errno, std::generic_category(), doing); }

// The values that a write carries; empty when its lengths contradict each other.
std::vector<std::uint16_t> values_of(const Request& request) {
  std::vector<std::uint16_t> values;
  if (request[function_at] == write_one) return {static_cast<std::uint16_t>(word_at(request, count_at))};
  const auto count = static_cast<std::size_t>(word_at(request, count_at));
  if (request.size() != many_values_at + 2 * count || request[many_values_at - 1] != 2 * count) return {};
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(static_cast<std::uint16_t>(word_at(request, many_values_at + 2 * i)));
  }
  return values;
}

}  // namespace

struct ModbusServer::Impl {
  std::vector<MappedUnit> units;
  ModbusServerFaults faults;  ///< under the devices' mutex
  std::unique_ptr<modbus_t, FreeContext> context;
  int listener = -1;
  int wake = -1;
  std::vector<Connection> connections;

  MappedUnit* find(int number) {
    const auto it = std::find_if(units.begin(), units.end(), [&](const auto& u) { return u.unit.unit == number; });
    return it == units.end() ? nullptr : &*it;
  }
  bool receive(Connection& connection, std::mutex& devices);
  void handle(Connection& connection, Request request);
  void answer(const Request& request);
  int carry_out(MappedUnit& unit, const Request& request);
  void reply_exception(const Request& request, int code) {
    modbus_reply_exception(context.get(), request.data(), static_cast<unsigned>(code));
  }
};

ModbusServer::ModbusServer(std::vector<ModbusUnit> units, std::mutex& devices)
    : devices_(devices), impl_(std::make_unique<Impl>()) {
  for (auto& unit : units) {
    std::unique_ptr<modbus_mapping_t, FreeMapping> mapping(modbus_mapping_new_start_address(
        0, 0, 0, 0, static_cast<unsigned>(unit.holding_start), static_cast<unsigned>(unit.holding_count),
        static_cast<unsigned>(unit.input_start), static_cast<unsigned>(unit.input_count)));
    if (!mapping) fail("Modbus mapping");
    impl_->units.push_back({std::move(unit), std::move(mapping)});
  }
  start();
}

ModbusServer::~ModbusServer() { stop(); }

void ModbusServer::start() {
  impl_->context.reset(modbus_new_tcp("127.0.0.1", port_));
  if (!impl_->context) fail("Modbus context");
  impl_->listener = modbus_tcp_listen(impl_->context.get(), 8);
  if (impl_->listener < 0) fail("listening on 127.0.0.1");
  sockaddr_in address{};
  socklen_t length = sizeof address;
  getsockname(impl_->listener, reinterpret_cast<sockaddr*>(&address), &length);
  port_ = ntohs(address.sin_port);
  impl_->wake = eventfd(0, EFD_CLOEXEC);
  if (impl_->wake < 0) fail("eventfd");
  thread_ = std::thread([this] { serve(); });
}

void ModbusServer::stop() {
  if (!thread_.joinable()) return;
  eventfd_write(impl_->wake, 1);
  thread_.join();
  for (const auto& connection : impl_->connections) close(connection.socket);
  impl_->connections.clear();
  close(impl_->listener);
  close(impl_->wake);
  // The context still names the last connection's socket, which is closed.
  modbus_set_socket(impl_->context.get(), -1);
}

void ModbusServer::restart() {
  if (!thread_.joinable()) start();
}

void ModbusServer::set_faults(const ModbusServerFaults& faults) {
  const std::lock_guard lock(devices_);
  impl_->faults = faults;
}

void ModbusServer::serve() {
  auto& connections = impl_->connections;
  for (;;) {
    std::vector<pollfd> waiting{{impl_->wake, POLLIN, 0}, {impl_->listener, POLLIN, 0}};
    for (const auto& connection : connections) waiting.push_back({connection.socket, POLLIN, 0});
    if (poll(waiting.data(), waiting.size(), -1) < 0) continue;
    if (waiting[0].revents != 0) return;
    for (std::size_t i = connections.size(); i-- > 0;) {
      if (waiting[i + 2].revents == 0 || impl_->receive(connections[i], devices_)) continue;
      close(connections[i].socket);
      connections.erase(connections.begin() + static_cast<std::ptrdiff_t>(i));
    }
    if (waiting[1].revents == 0) continue;
    const int socket = accept4(impl_->listener, nullptr, nullptr, SOCK_CLOEXEC);
    if (socket >= 0) connections.push_back({socket, {}});
  }
}

// One request. False when the connection is gone.
bool ModbusServer::Impl::receive(Connection& connection, std::mutex& devices) {
  modbus_set_socket(context.get(), connection.socket);
  std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH> buffer{};
  const int length = modbus_receive(context.get(), buffer.data());
  if (length < 0) return false;
  if (static_cast<std::size_t>(length) < count_at + 2) return true;
  const std::lock_guard lock(devices);
  handle(connection, Request(buffer.begin(), buffer.begin() + length));
  return true;
}

void ModbusServer::Impl::handle(Connection& connection, Request request) {
  if (!connection.unanswered.empty()) answer(std::exchange(connection.unanswered, {}));
  if (faults.stalled) return;
  if (faults.exception != 0) return reply_exception(request, faults.exception);
  auto* unit = find(request[unit_at]);
  if (unit == nullptr) return reply_exception(request, no_such_unit);
  if (const int code = carry_out(*unit, request)) return reply_exception(request, code);
  if (faults.silent) return;
  if (faults.late) {
    connection.unanswered = std::move(request);
    return;
  }
  answer(request);
}

int ModbusServer::Impl::carry_out(MappedUnit& unit, const Request& request) {
  const int function = request[function_at];
  if (function == read_holding || function == read_input) return 0;
  if (function != write_one && function != write_many) return illegal_function;
  const auto values = values_of(request);
  if (values.empty()) return illegal_value;
  return unit.unit.write(word_at(request, address_at), values);
}

void ModbusServer::Impl::answer(const Request& request) {
  auto* unit = find(request[unit_at]);
  if (unit == nullptr) return;
  if (!faults.freeze_inputs) {
    unit->unit.read_inputs({unit->mapping->tab_input_registers, static_cast<std::size_t>(unit->unit.input_count)});
  }
  modbus_reply(context.get(), request.data(), static_cast<int>(request.size()), unit->mapping.get());
}

}  // namespace hogline::hw::sim
