#include "hw/modbus/modbus_transport.hpp"

#include <fcntl.h>
#include <modbus/modbus.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <stdexcept>

namespace hogline::hw {

namespace {

constexpr int device_failure = 4;  // the exception code by which a device says that it is broken

modbus_t* new_context(const ModbusTcp& line) { return modbus_new_tcp(line.address.c_str(), line.port); }
modbus_t* new_context(const ModbusRtu& line) {
  return modbus_new_rtu(line.device.c_str(), line.baud, line.parity, line.data_bits, line.stop_bits);
}

ModbusFault disconnected(const char* doing, int error) {
  return {DeviceErrorKind::disconnected, std::string(doing) + ": " + modbus_strerror(error)};
}

// Waits until the descriptor is ready or the deadline has passed. False then. Looks once even when the deadline has
// passed already: what has arrived counts, however late this thread was to look.
bool wait_for(int descriptor, short event, std::chrono::steady_clock::time_point deadline) {
  pollfd waiting{descriptor, event, 0};
  for (;;) {
    const auto left = std::max(deadline - std::chrono::steady_clock::now(), std::chrono::steady_clock::duration{});
    const timespec span{static_cast<time_t>(left / std::chrono::seconds(1)),
                        static_cast<long>((left % std::chrono::seconds(1)).count())};
    const int ready = ppoll(&waiting, 1, &span, nullptr);
    if (ready > 0) return true;  // also for a line that is gone: reading or writing says so
    if (ready == 0) return false;
    if (errno != EINTR) return true;
  }
}

}  // namespace

void ModbusTransport::Free::operator()(modbus_t* context) const {
  modbus_close(context);
  modbus_free(context);
}

ModbusTransport::ModbusTransport(const ModbusLineConfig& config)
    : framing_(std::holds_alternative<ModbusTcp>(config.line) ? modbus::Framing::tcp : modbus::Framing::rtu),
      timeout_(std::chrono::duration_cast<std::chrono::microseconds>(config.response_timeout)),
      context_(std::visit([](const auto& line) { return new_context(line); }, config.line)) {
  if (!context_) throw std::invalid_argument("Modbus line: the address or serial settings are not usable");
  if (timeout_.count() <= 0) throw std::invalid_argument("Modbus line: the response timeout must be positive");
  modbus_set_error_recovery(context_.get(), MODBUS_ERROR_RECOVERY_NONE);
  // Bounds an attempt to connect.
  modbus_set_response_timeout(context_.get(), static_cast<std::uint32_t>(timeout_.count() / 1000000),
                              static_cast<std::uint32_t>(timeout_.count() % 1000000));
}

std::optional<ModbusFault> ModbusTransport::open() {
  close();
  if (modbus_connect(context_.get()) != 0) {
    const auto fault = disconnected("connecting", errno);
    modbus_close(context_.get());
    return fault;
  }
  const int descriptor = modbus_get_socket(context_.get());
  fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) | O_NONBLOCK);
  open_ = true;
  return std::nullopt;
}

void ModbusTransport::close() {
  if (open_) modbus_close(context_.get());
  open_ = false;
}

std::variant<modbus::Answer, ModbusFault> ModbusTransport::exchange(const modbus::Request& request) {
  if (!open_) return ModbusFault{DeviceErrorKind::disconnected, "no connection"};
  modbus_flush(context_.get());
  ++transaction_;
  const Deadline deadline = std::chrono::steady_clock::now() + timeout_;
  if (auto fault = send(modbus::encode(request, framing_, transaction_), deadline)) return *fault;
  return receive(request, deadline);
}

std::optional<ModbusFault> ModbusTransport::send(std::span<const std::uint8_t> bytes, Deadline deadline) {
  const int descriptor = modbus_get_socket(context_.get());
  while (!bytes.empty()) {
    const auto sent = framing_ == modbus::Framing::tcp ? ::send(descriptor, bytes.data(), bytes.size(), MSG_NOSIGNAL)
                                                       : ::write(descriptor, bytes.data(), bytes.size());
    if (sent > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(sent));
    } else if (sent < 0 && errno != EAGAIN && errno != EINTR) {
      return disconnected("sending", errno);
    } else if (!wait_for(descriptor, POLLOUT, deadline)) {
      return ModbusFault{DeviceErrorKind::timeout, "the line takes no bytes"};
    }
  }
  return std::nullopt;
}

std::variant<modbus::Answer, ModbusFault> ModbusTransport::receive(const modbus::Request& request, Deadline deadline) {
  const int descriptor = modbus_get_socket(context_.get());
  std::array<std::uint8_t, MODBUS_MAX_ADU_LENGTH> buffer{};
  for (std::size_t filled = 0;;) {
    if (!wait_for(descriptor, POLLIN, deadline)) {
      return ModbusFault{DeviceErrorKind::timeout, filled == 0 ? "no answer" : "the answer is cut short"};
    }
    const auto got = ::read(descriptor, buffer.data() + filled, buffer.size() - filled);
    if (got < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    if (got < 0) return disconnected("receiving", errno);
    if (got == 0) return ModbusFault{DeviceErrorKind::disconnected, "the other end closed the line"};
    filled += static_cast<std::size_t>(got);
    auto answer = modbus::judge({buffer.data(), filled}, request, framing_, transaction_);
    if (answer.verdict == modbus::Verdict::wrong) {
      return ModbusFault{DeviceErrorKind::protocol, std::string(answer.reason)};
    }
    if (answer.verdict == modbus::Verdict::exception) {
      return ModbusFault{answer.exception == device_failure ? DeviceErrorKind::device_fault : DeviceErrorKind::refused,
                         "exception " + std::to_string(answer.exception) + ": " +
                             std::string(modbus::exception_meaning(answer.exception))};
    }
    if (answer.verdict == modbus::Verdict::good) return answer;
  }
}

std::optional<ModbusFault> ModbusTransport::read_input(int unit, int address, std::span<std::uint16_t> values) {
  auto result = exchange(modbus::read_input_registers(unit, address, values.size()));
  if (auto* fault = std::get_if<ModbusFault>(&result)) return std::move(*fault);
  std::ranges::copy(std::get<modbus::Answer>(result).values, values.begin());
  return std::nullopt;
}

std::optional<ModbusFault> ModbusTransport::write(int unit, int address, std::span<const std::uint16_t> values) {
  auto result = exchange(modbus::write_registers(unit, address, values));
  if (auto* fault = std::get_if<ModbusFault>(&result)) return std::move(*fault);
  return std::nullopt;
}

}  // namespace hogline::hw
