// The only file that knows libmodbus and file descriptors.
#include <fcntl.h>
#include <modbus/modbus.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>

#include "hw/modbus/modbus_line.hpp"

namespace hogline::hw {
namespace {

using Clock = std::chrono::steady_clock;

modbus_t* new_context(const ModbusTcp& line) { return modbus_new_tcp(line.address.c_str(), line.port); }
modbus_t* new_context(const ModbusRtu& line) {
  return modbus_new_rtu(line.device.c_str(), line.baud, line.parity, line.data_bits, line.stop_bits);
}

ModbusFault disconnected(const char* doing, int error) {
  return {DeviceErrorKind::disconnected, std::string(doing) + ": " + modbus_strerror(error)};
}

// Waits until the descriptor is ready or the deadline has passed. False then. Looks once even when the deadline has
// passed already: what has arrived counts, however late this thread was to look.
bool wait_for(int descriptor, short event, Clock::time_point deadline) {
  pollfd waiting{descriptor, event, 0};
  for (;;) {
    const auto left = std::max(deadline - Clock::now(), Clock::duration{});
    const timespec span{static_cast<time_t>(left / std::chrono::seconds(1)),
                        static_cast<long>((left % std::chrono::seconds(1)).count())};
    const int ready = ppoll(&waiting, 1, &span, nullptr);
    if (ready > 0) return true;  // also for a line that is gone: reading or writing says so
    if (ready == 0) return false;
    if (errno != EINTR) return true;
  }
}

struct Free {
  void operator()(modbus_t* context) const {
    modbus_close(context);
    modbus_free(context);
  }
};

// libmodbus opens, sets up, flushes and closes the line.
class KernelLine final : public ModbusLine {
 public:
  explicit KernelLine(const ModbusLineConfig& config)
      : tcp_(std::holds_alternative<ModbusTcp>(config.line)),
        timeout_(std::chrono::duration_cast<std::chrono::microseconds>(config.response_timeout)),
        context_(std::visit([](const auto& line) { return new_context(line); }, config.line)) {
    if (!context_) throw std::invalid_argument("Modbus line: the address or serial settings are not usable");
    if (timeout_.count() <= 0) throw std::invalid_argument("Modbus line: the response timeout must be positive");
    modbus_set_error_recovery(context_.get(), MODBUS_ERROR_RECOVERY_NONE);
    // Bounds an attempt to connect.
    modbus_set_response_timeout(context_.get(), static_cast<std::uint32_t>(timeout_.count() / 1000000),
                                static_cast<std::uint32_t>(timeout_.count() % 1000000));
  }

  std::optional<ModbusFault> open() override {
    close();
    if (modbus_connect(context_.get()) != 0) {
      const auto fault = disconnected("connecting", errno);
      modbus_close(context_.get());
      return fault;
    }
    fcntl(descriptor(), F_SETFL, fcntl(descriptor(), F_GETFL) | O_NONBLOCK);
    open_ = true;
    return std::nullopt;
  }

  void close() override {
    if (open_) modbus_close(context_.get());
    open_ = false;
  }

  void begin() override {
    modbus_flush(context_.get());
    deadline_ = Clock::now() + timeout_;
  }

  std::optional<ModbusFault> send(std::span<const std::uint8_t> bytes) override {
    while (!bytes.empty()) {
      const auto sent = tcp_ ? ::send(descriptor(), bytes.data(), bytes.size(), MSG_NOSIGNAL)
                             : ::write(descriptor(), bytes.data(), bytes.size());
      if (sent > 0) {
        bytes = bytes.subspan(static_cast<std::size_t>(sent));
      } else if (sent < 0 && errno != EAGAIN && errno != EINTR) {
        return disconnected("sending", errno);
      } else if (!wait_for(descriptor(), POLLOUT, deadline_)) {
        return ModbusFault{DeviceErrorKind::timeout, "the line takes no bytes"};
      }
    }
    return std::nullopt;
  }

  std::variant<std::size_t, ModbusFault> receive(std::span<std::uint8_t> buffer) override {
    while (wait_for(descriptor(), POLLIN, deadline_)) {
      const auto got = ::read(descriptor(), buffer.data(), buffer.size());
      if (got > 0) return static_cast<std::size_t>(got);
      if (got == 0) return ModbusFault{DeviceErrorKind::disconnected, "the other end closed the line"};
      if (errno != EAGAIN && errno != EINTR) return disconnected("receiving", errno);
    }
    return ModbusFault{DeviceErrorKind::timeout, "nothing arrives"};
  }

 private:
  int descriptor() const { return modbus_get_socket(context_.get()); }

  bool tcp_;
  std::chrono::microseconds timeout_;
  std::unique_ptr<modbus_t, Free> context_;
  bool open_ = false;
  Clock::time_point deadline_{};
};

}  // namespace

std::unique_ptr<ModbusLine> open_kernel_line(const ModbusLineConfig& config) {
  return std::make_unique<KernelLine>(config);
}

}  // namespace hogline::hw
