// What answers on a Modbus line, with faults to order: bytes in, bytes out, no IO.
#pragma once

#include "hw/sim/modbus_wire.hpp"

namespace hogline::hw::sim {

/// Faults that are committed until told otherwise.
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

/// One client's line.
struct ModbusStationLine {
  ModbusWire wire = ModbusWire::tcp;
  ModbusBytes received{};
  ModbusBytes unsent{};    ///< what a late station still owes
  bool forgotten = false;  ///< half open: never looked at again
};

struct ModbusReply {
  ModbusBytes bytes{};
  bool resets = false;  ///< the connection is to be reset behind them
};

class ModbusStation {
 public:
  explicit ModbusStation(std::vector<ModbusUnit> units) : slave_(std::move(units)) {}

  void set_faults(const ModbusServerFaults& faults);
  /// What is said to bytes that have arrived. An RTU unit that is not there is silent.
  ModbusReply take(ModbusStationLine& line, std::span<const std::uint8_t> bytes);

 private:
  void answer(ModbusStationLine& line, const ModbusRequest& request, ModbusReply& reply);
  void deliver(ModbusStationLine& line, const ModbusRequest& request, ModbusReply& reply, ModbusBytes answer) const;

  ModbusSlave slave_;
  ModbusServerFaults faults_;
};

}  // namespace hogline::hw::sim
