// The simulated rink's Modbus devices as a line of bytes.
#pragma once

#include "hw/byte_line.hpp"
#include "hw/sim/modbus_plug.hpp"

namespace hogline {

class RinkModbusLine final : public hw::ByteLine {
 public:
  RinkModbusLine(hw::sim::ModbusDevices& devices, hw::sim::ModbusWire wire) : plug_(devices, wire) {}
  std::optional<std::string> open() override {
    if (plug_.open()) return std::nullopt;
    return "connection refused";
  }
  void close() override { plug_.close(); }
  std::optional<std::string> read() override { return plug_.read(); }
  bool write(std::string_view bytes) override { return plug_.write(bytes); }

 private:
  hw::sim::ModbusPlug plug_;
};

}  // namespace hogline
