// A client's end of a line to the simulated Modbus devices, inside one program: what is written is answered before the
// call returns, so that a stepped simulation waits for no clock and no other thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "hw/sim/modbus_station.hpp"

namespace hogline::hw::sim {

class ModbusDevices;

class ModbusPlug {
 public:
  /// The devices must outlive the plug.
  ModbusPlug(ModbusDevices& devices, ModbusWire wire) : devices_(devices), wire_(wire) {}

  /// Connects anew. False when nobody listens.
  bool open();
  void close() { line_.reset(); }
  /// False when the line is gone.
  bool write(std::string_view bytes);
  /// What has been answered and was not read before; nothing when the line is gone.
  std::optional<std::string> read();

 private:
  bool connected() const;

  ModbusDevices& devices_;
  ModbusWire wire_;
  std::optional<ModbusStationLine> line_;
  unsigned serving_ = 0;  ///< ModbusDevices::serving() when it was opened
  std::string answered_;
  bool resets_ = false;  ///< gone when `answered_` is read
};

}  // namespace hogline::hw::sim
