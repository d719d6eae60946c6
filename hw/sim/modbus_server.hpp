// A Modbus server on the loopback interface and, where asked for, on a pseudo terminal as RTU; with faults to order.
// Knows sockets and units, no device.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "hw/sim/modbus_slave.hpp"

namespace hogline::hw::sim {

/// Faults that the server commits until told otherwise.
struct ModbusServerFaults {
  bool stalled = false;          ///< accepts and reads, never carries out, never answers
  bool silent = false;           ///< carries out, never answers
  bool late = false;             ///< each answer waits until the next request of its line arrives
  int exception = 0;             ///< every request gets this exception code
  bool freeze_inputs = false;    ///< input registers keep their values
  bool reset_mid_frame = false;  ///< sends half of an answer, then resets the connection
  bool half_open = false;        ///< forgets every connection as soon as it is used: nothing is read or answered on it
  /// Changes the bytes of an answer before they are sent.
  std::function<ModbusBytes(const ModbusBytes& request, ModbusBytes answer)> tamper{};
};

class ModbusServer {
 public:
  /// Listens on 127.0.0.1 at a free port. Throws std::system_error when that is not possible.
  ModbusServer(std::vector<ModbusUnit> units, std::mutex& devices);
  ~ModbusServer();
  ModbusServer(const ModbusServer&) = delete;
  ModbusServer& operator=(const ModbusServer&) = delete;

  int port() const { return port_; }
  /// Also answers RTU on a pseudo terminal from now on; the path of its other end. A unit that is not there is silent.
  std::string serve_rtu();
  void set_faults(const ModbusServerFaults& faults);
  /// Closes every connection, the listening socket and the pseudo terminal; when it returns they are closed.
  void stop();
  /// Listens again, on the same port; the pseudo terminal gets a new path.
  void restart();
  std::string rtu_path() const { return rtu_path_; }

 private:
  struct Impl;
  void start();
  void open_terminal();

  std::mutex& devices_;
  std::unique_ptr<Impl> impl_;
  int port_ = 0;
  bool serves_rtu_ = false;
  std::string rtu_path_;
  std::thread thread_;
};

}  // namespace hogline::hw::sim
