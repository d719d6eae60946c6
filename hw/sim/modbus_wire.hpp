// How a Modbus server cuts requests out of a stream of bytes and wraps its answers: TCP and RTU. Written from MODBUS
// Messaging on TCP/IP V1.0b and MODBUS over Serial Line V1.02.
#pragma once

#include <optional>

#include "hw/sim/modbus_slave.hpp"

namespace hogline::hw::sim {

enum class ModbusWire { tcp, rtu };

struct ModbusRequest {
  int unit = 0;
  ModbusBytes data;    ///< function and data
  ModbusBytes header;  ///< what an answer repeats: TCP's transaction and protocol, nothing for RTU
  ModbusBytes raw;     ///< as it came
};

/// Takes the first whole request out of the front of `bytes`; nothing while it is incomplete. What can be no request
/// (wrong protocol or length, wrong CRC, an RTU function whose length is not known) empties `bytes`: a server says
/// nothing to it.
std::optional<ModbusRequest> take_request(ModbusWire wire, ModbusBytes& bytes);

/// The answer's bytes: function and data with the request's header and unit, or with RTU's CRC.
ModbusBytes wrap_answer(ModbusWire wire, const ModbusRequest& request, const ModbusBytes& data);

}  // namespace hogline::hw::sim
