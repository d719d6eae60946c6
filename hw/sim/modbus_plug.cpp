#include "hw/sim/modbus_plug.hpp"

#include <utility>

#include "hw/sim/modbus_devices.hpp"

namespace hogline::hw::sim {

bool ModbusPlug::open() {
  close();
  answered_.clear();
  resets_ = false;
  serving_ = devices_.serving();
  if (serving_ == 0) return false;
  line_ = ModbusStationLine{.wire = wire_};
  return true;
}

bool ModbusPlug::connected() const { return line_ && devices_.serving() == serving_; }

bool ModbusPlug::write(std::string_view bytes) {
  if (!connected() || resets_) return false;
  // A client writes whole requests: what was left of another one has ended with the silence before this one.
  if (wire_ == ModbusWire::rtu) line_->received.clear();
  const ModbusReply reply = devices_.take(*line_, {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  answered_.append(reply.bytes.begin(), reply.bytes.end());
  resets_ = reply.resets;
  return true;
}

std::optional<std::string> ModbusPlug::read() {
  if (!connected() || (resets_ && answered_.empty())) return std::nullopt;
  return std::exchange(answered_, {});
}

}  // namespace hogline::hw::sim
