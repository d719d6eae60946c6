// A Modbus station on the loopback interface and, where asked for, on a pseudo terminal as RTU. Knows sockets, no
// device.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "hw/sim/modbus_station.hpp"

namespace hogline::hw::sim {

class ModbusServer {
 public:
  /// Listens on 127.0.0.1, at a free port where 0 is asked for. Throws std::system_error when that is not possible. The
  /// station is used under the mutex; both must outlive the server.
  ModbusServer(ModbusStation& station, std::mutex& devices, int port = 0);
  ~ModbusServer();
  ModbusServer(const ModbusServer&) = delete;
  ModbusServer& operator=(const ModbusServer&) = delete;

  int port() const { return port_; }
  /// Also answers RTU on a pseudo terminal from now on; the path of its other end. A unit that is not there is silent.
  std::string serve_rtu();
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
