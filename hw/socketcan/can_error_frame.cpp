#include "hw/socketcan/can_error_frame.hpp"

#include <linux/can/error.h>

namespace hogline::hw {

const char* to_string(CanControllerState state) {
  switch (state) {
    case CanControllerState::active:
      return "error active";
    case CanControllerState::warning:
      return "error warning";
    case CanControllerState::passive:
      return "error passive";
    case CanControllerState::bus_off:
      return "bus-off";
  }
  return "unknown";
}

namespace {

std::optional<CanControllerState> entered_state(std::uint32_t id, std::uint8_t controller_bits) {
  if (id & CAN_ERR_BUSOFF) return CanControllerState::bus_off;
  if (id & CAN_ERR_CRTL) {
    if (controller_bits & (CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE)) return CanControllerState::passive;
    if (controller_bits & (CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING)) return CanControllerState::warning;
    if (controller_bits & CAN_ERR_CRTL_ACTIVE) return CanControllerState::active;
  }
  if (id & CAN_ERR_RESTARTED) return CanControllerState::active;
  return std::nullopt;
}

// CAN_ERR_CNT is a flag of Linux 6.0; older drivers fill the counters without it, so
// non-zero counters are taken as given. In a bus-off frame they have no meaning.
std::optional<CanErrorCounters> counters(std::uint32_t id, std::uint8_t transmit, std::uint8_t receive) {
  const bool given = (id & CAN_ERR_CNT) || transmit != 0 || receive != 0;
  if (!given || (id & CAN_ERR_BUSOFF)) return std::nullopt;
  return CanErrorCounters{transmit, receive};
}

}  // namespace

CanErrorFrame decode_error_frame(std::uint32_t id, const std::array<std::uint8_t, 8>& data) {
  const bool about_controller = (id & CAN_ERR_CRTL) != 0;
  CanErrorFrame decoded;
  decoded.state = entered_state(id, data[1]);
  decoded.counters = counters(id, data[6], data[7]);
  decoded.restarted = (id & CAN_ERR_RESTARTED) != 0;
  decoded.no_acknowledge = (id & CAN_ERR_ACK) != 0;
  decoded.transmit_timeout = (id & CAN_ERR_TX_TIMEOUT) != 0;
  decoded.arbitration_lost = (id & CAN_ERR_LOSTARB) != 0;
  decoded.bus_error = (id & (CAN_ERR_BUSERROR | CAN_ERR_PROT)) != 0;
  decoded.transceiver_fault = (id & CAN_ERR_TRX) != 0;
  decoded.receive_overflow = about_controller && (data[1] & CAN_ERR_CRTL_RX_OVERFLOW);
  decoded.transmit_overflow = about_controller && (data[1] & CAN_ERR_CRTL_TX_OVERFLOW);
  return decoded;
}

}  // namespace hogline::hw
