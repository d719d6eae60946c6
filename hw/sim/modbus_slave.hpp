// The server side of Modbus, apart from any wire: units, registers, functions and exceptions. Written from the MODBUS
// Application Protocol V1.1b3.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace hogline::hw::sim {

using ModbusBytes = std::vector<std::uint8_t>;

/// One unit. The callbacks are made in the server's thread, with its mutex held.
struct ModbusUnit {
  int unit = 0;
  int holding_start = 0;
  int holding_count = 0;
  int input_start = 0;
  int input_count = 0;
  std::function<int(int address, std::span<const std::uint16_t> values)> write;  ///< gives an exception code, 0 is good
  std::function<void(std::span<std::uint16_t> inputs)> read_inputs;
};

class ModbusSlave {
 public:
  explicit ModbusSlave(std::vector<ModbusUnit> units);

  bool knows(int unit) const;
  /// Function and data in, function and data out. Functions 3, 4, 6 and 16; exceptions 1, 2, 3, the unit's own, and 11
  /// for a unit that is not there. Any bytes get an answer.
  ModbusBytes answer(int unit, std::span<const std::uint8_t> request);
  /// The answer to any request while a unit is out of order.
  static ModbusBytes exception(std::span<const std::uint8_t> request, int code);
  /// Fault injection: while frozen, input registers keep the values they had when they were last read.
  void freeze_inputs(bool frozen) { frozen_ = frozen; }

 private:
  struct Registers {
    ModbusUnit unit;
    std::vector<std::uint16_t> holding;  ///< as last written
    std::vector<std::uint16_t> inputs;   ///< as last read
  };
  ModbusBytes read(Registers& unit, std::span<const std::uint8_t> request);
  ModbusBytes write(Registers& unit, std::span<const std::uint8_t> request);
  Registers* find(int number);

  std::vector<Registers> units_;
  bool frozen_ = false;
};

}  // namespace hogline::hw::sim
