// What the two robots and their strategist tell each other. Plain values; who carries them is the link's business.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "vision/percepts/stamp.hpp"

namespace hogline::hw {

/// UTC as the sender's machine has it. A sender reads the wall clock once, at its start, and counts on in its steady
/// clock, so a step of the wall clock does not reach a message. Two machines differ by an offset, which the link
/// measures.
using TeamTime = std::chrono::time_point<std::chrono::system_clock, Duration>;

/// Who says it. The link fills it in; what a sender writes here is overwritten.
struct Origin {
  std::string robot;          ///< the sender's name in its rig file: "thrower", "skip"
  std::uint64_t session = 0;  ///< one per process and start, growing from start to start; never 0
  std::uint64_t serial = 0;   ///< of this sender's messages of this kind, from 1
  TeamTime stamp{};           ///< when what the message tells happened
  bool operator==(const Origin&) const = default;
};

/// Throw this. It is meant for one start of one thrower: an order recorded yesterday names another session.
struct ShotOrderMessage {
  Origin origin;
  std::uint64_t thrower_session = 0;  ///< as the thrower's state messages give it
  std::uint32_t shot = 0;             ///< of the end, 1..16
  double speed_mps = 0.0;             ///< of the stone at its release
  double heading_rad = 0.0;           ///< in the thrower's e, counter-clockwise positive, of a line through the hack
  double spin_radps = 0.0;            ///< counter-clockwise from above positive
  bool operator==(const ShotOrderMessage&) const = default;
};

enum class ThrowerPhase : std::uint8_t { idle, aligning, running, released, stopped, fault };

struct ThrowerStateMessage {
  Origin origin;
  ThrowerPhase phase = ThrowerPhase::idle;
  bool armed = false;              ///< the operator's switch
  std::uint64_t order_serial = 0;  ///< the order being thrown or thrown last; 0: none
  std::string reason;              ///< why stopped or faulty, or why the last order was refused; else empty
  bool operator==(const ThrowerStateMessage&) const = default;
};

/// The stone is free. The origin's stamp is the moment at which the jaws had let it go.
struct ReleaseMessage {
  Origin origin;
  std::uint64_t order_serial = 0;
  double hog_distance_m = 0.0;  ///< from the stone's centre to the hog line's house-side edge
  double lateral_m = 0.0;       ///< of the stone's centre from e's y axis, right positive
  double speed_mps = 0.0;
  double heading_rad = 0.0;
  double spin_radps = 0.0;
  bool operator==(const ReleaseMessage&) const = default;
};

struct TeamStone {
  double x_m = 0.0;  ///< in the skip's e
  double y_m = 0.0;
  std::array<double, 3> covariance_m2{};  ///< xx, xy, yy
  std::string team;                       ///< "first", "second" or "unknown"
  bool operator==(const TeamStone&) const = default;
};

/// The stones that rest on the sheet.
struct BoardMessage {
  Origin origin;
  bool ok = false;
  std::string reason;
  std::vector<TeamStone> stones;
  bool operator==(const BoardMessage&) const = default;
};

/// The thrown stone while it runs, for whoever sweeps or watches.
struct StoneTrackMessage {
  Origin origin;
  std::uint64_t order_serial = 0;
  bool seen = false;  ///< in this very look; else it is predicted
  double x_m = 0.0;
  double y_m = 0.0;
  double vx_mps = 0.0;
  double vy_mps = 0.0;
  std::array<double, 3> place_covariance_m2{};        ///< xx, xy, yy
  std::array<double, 3> velocity_covariance_m2ps2{};  ///< the same of the velocity
  bool operator==(const StoneTrackMessage&) const = default;
};

struct OutcomeMessage {
  Origin origin;
  std::uint64_t order_serial = 0;
  bool ok = false;
  std::string reason;
  std::string fate;  ///< of the thrown stone: "at_rest", "hogged", "sideline", "through" or "lost"
  double x_m = 0.0;  ///< where it rests, or was last
  double y_m = 0.0;
  std::optional<double> hog_to_hog_s;
  std::optional<double> hog_to_rest_s;
  std::optional<double> curl_m;
  std::uint32_t collisions = 0;
  bool operator==(const OutcomeMessage&) const = default;
};

/// What the sender heard last of another robot: with it, the other computes the offset of the two clocks.
struct Echo {
  std::string robot;
  std::uint64_t session = 0;
  TeamTime sent{};   ///< the heard heartbeat's stamp, in the other's clock
  TeamTime heard{};  ///< when it came, in the sender's clock
  bool operator==(const Echo&) const = default;
};

/// Sent by the control thread itself at a fixed rate, so that a hung controller falls silent.
struct HeartbeatMessage {
  Origin origin;
  std::vector<Echo> echoes;
  bool operator==(const HeartbeatMessage&) const = default;
};

/// To all. Stays in force until the same robot takes it back, or an operator re-arms.
struct EmergencyStopMessage {
  Origin origin;
  bool pressed = true;
  std::string reason;
  bool operator==(const EmergencyStopMessage&) const = default;
};

using TeamMessage = std::variant<ShotOrderMessage, ThrowerStateMessage, ReleaseMessage, BoardMessage, StoneTrackMessage,
                                 OutcomeMessage, HeartbeatMessage, EmergencyStopMessage>;

inline const Origin& origin_of(const TeamMessage& message) {
  return std::visit([](const auto& m) -> const Origin& { return m.origin; }, message);
}

}  // namespace hogline::hw
