#include "hw/sim/modbus_station.hpp"

#include <cstddef>
#include <utility>

namespace hogline::hw::sim {

void ModbusStation::set_faults(const ModbusServerFaults& faults) {
  faults_ = faults;
  slave_.freeze_inputs(faults.freeze_inputs);
}

ModbusReply ModbusStation::take(ModbusStationLine& line, std::span<const std::uint8_t> bytes) {
  ModbusReply reply;
  if (faults_.half_open && line.wire == ModbusWire::tcp) line.forgotten = true;
  if (line.forgotten) return reply;
  line.received.insert(line.received.end(), bytes.begin(), bytes.end());
  while (!reply.resets) {
    const auto request = take_request(line.wire, line.received);
    if (!request) break;
    answer(line, *request, reply);
  }
  return reply;
}

void ModbusStation::answer(ModbusStationLine& line, const ModbusRequest& request, ModbusReply& reply) {
  const ModbusBytes owed = std::exchange(line.unsent, {});
  reply.bytes.insert(reply.bytes.end(), owed.begin(), owed.end());
  if (faults_.stalled) return;
  if (line.wire == ModbusWire::rtu && !slave_.knows(request.unit)) return;
  const auto data = faults_.exception != 0 ? ModbusSlave::exception(request.data, faults_.exception)
                                           : slave_.answer(request.unit, request.data);
  deliver(line, request, reply, wrap_answer(line.wire, request, data));
}

// The answer, or what the faults make of it.
void ModbusStation::deliver(ModbusStationLine& line, const ModbusRequest& request, ModbusReply& reply,
                            ModbusBytes answer) const {
  if (faults_.silent) return;
  if (faults_.tamper) answer = faults_.tamper(request.raw, std::move(answer));
  if (faults_.late) {
    line.unsent = std::move(answer);
    return;
  }
  if (faults_.reset_mid_frame) {
    answer.resize(answer.size() / 2);
    reply.resets = line.wire == ModbusWire::tcp;
  }
  reply.bytes.insert(reply.bytes.end(), answer.begin(), answer.end());
}

}  // namespace hogline::hw::sim
