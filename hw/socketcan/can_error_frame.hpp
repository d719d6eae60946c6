// What SocketCAN's error frames say (linux/can/error.h): pure decoding.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace hogline::hw {

/// The controller's fault confinement (ISO 11898-1, 12.1.4). In bus-off it neither sends nor receives.
enum class CanControllerState { active, warning, passive, bus_off };

/// The name of a state, for logs and reasons.
const char* to_string(CanControllerState state);

/// The transmit and receive error counters of ISO 11898-1.
struct CanErrorCounters {
  std::uint8_t transmit = 0;
  std::uint8_t receive = 0;
};

/// One decoded error frame. Several flags may be set at once.
struct CanErrorFrame {
  std::optional<CanControllerState> state;   ///< the state that the controller has just entered, where the frame says
  std::optional<CanErrorCounters> counters;  ///< where the driver gives them
  bool restarted = false;                    ///< the controller has left bus-off
  bool no_acknowledge = false;               ///< nobody on the bus acknowledged a frame
  bool transmit_timeout = false;
  bool arbitration_lost = false;
  bool bus_error = false;          ///< bit, form, stuff or CRC error on the wire
  bool transceiver_fault = false;  ///< wiring: open, short, no termination
  bool receive_overflow = false;   ///< the controller lost received frames
  bool transmit_overflow = false;
};

/// Decodes an error frame from its identifier word (with or without CAN_ERR_FLAG) and its eight data bytes. Total:
/// every input gives a result, unknown bits are ignored.
CanErrorFrame decode_error_frame(std::uint32_t id, const std::array<std::uint8_t, 8>& data);

}  // namespace hogline::hw
