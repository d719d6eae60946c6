// A Modbus TCP server on the loopback interface, with faults to order. Knows sockets and units, no device.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

namespace hogline::hw::sim {

/// One unit behind the server. The callbacks are made in the server's thread, with its mutex held.
struct ModbusUnit {
  int unit = 0;
  int holding_start = 0;
  int holding_count = 0;
  int input_start = 0;
  int input_count = 0;
  std::function<int(int address, std::span<const std::uint16_t> values)> write;  ///< gives an exception code, 0 is good
  std::function<void(std::span<std::uint16_t> inputs)> read_inputs;
};

/// Faults that the server commits until told otherwise.
struct ModbusServerFaults {
  bool stalled = false;        ///< accepts and reads, never carries out, never answers
  bool silent = false;         ///< carries out, never answers
  bool late = false;           ///< each answer waits until the next request of its connection arrives
  int exception = 0;           ///< every request gets this exception code
  bool freeze_inputs = false;  ///< input registers keep their values
};

class ModbusServer {
 public:
  /// Listens on 127.0.0.1 at a free port. Throws std::system_error when that is not possible.
  ModbusServer(std::vector<ModbusUnit> units, std::mutex& devices);
  ~ModbusServer();
  ModbusServer(const ModbusServer&) = delete;
  ModbusServer& operator=(const ModbusServer&) = delete;

  int port() const { return port_; }
  void set_faults(const ModbusServerFaults& faults);
  /// Closes every connection and the listening socket; when it returns they are closed.
  void stop();
  /// Listens again, on the same port.
  void restart();

 private:
  struct Impl;
  void start();
  void serve();

  std::mutex& devices_;
  std::unique_ptr<Impl> impl_;
  int port_ = 0;
  std::thread thread_;
};

}  // namespace hogline::hw::sim
