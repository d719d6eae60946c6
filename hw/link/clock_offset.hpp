// The offset between two robots' clocks, from the heartbeats that they exchange anyway: four stamps a round trip, the
// shortest of the last ones counts (as NTP's clock filter, RFC 5905 section 10, in its simplest form).
#pragma once

#include <array>
#include <optional>

#include "hw/team_messages.hpp"

namespace hogline::hw::link {

struct OffsetEstimate {
  Duration offset{};      ///< the other's clock less ours
  Duration round_trip{};  ///< of the exchange it rests on
  /// The most by which the offset can be wrong: half the round trip, were all of it on one way.
  Duration bound{};
};

/// One other robot, in one session of its.
class ClockOffset {
 public:
  /// A heartbeat of theirs that tells when ours came in. `sent` and `heard` are the echo's; `answered` the stamp of the
  /// heartbeat that carries it; `received` when it came in, in our clock. An exchange whose parts are out of order is
  /// left out.
  void add(TeamTime sent, TeamTime heard, TeamTime answered, TeamTime received);

  /// Empty: no whole exchange yet.
  std::optional<OffsetEstimate> estimate() const;

 private:
  struct Exchange {
    Duration offset{};
    Duration round_trip{};
  };
  std::array<Exchange, 16> last_{};
  std::size_t count_ = 0;
};

}  // namespace hogline::hw::link
