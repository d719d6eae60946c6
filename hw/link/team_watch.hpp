// Who of the team is there: heard, silent, come back as another start; and how its clock differs from ours.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hw/link/clock_offset.hpp"

namespace hogline::hw::link {

enum class Presence {
  unheard,  ///< never since our start
  there,
  silent,  ///< was there, and has said nothing for longer than it may
};

struct PeerState {
  Presence presence = Presence::unheard;
  std::uint64_t session = 0;  ///< 0: unheard
  Duration age{};             ///< since its last heartbeat; meaningless when unheard
  int restarts = 0;           ///< how often it came back as another start
  long missed = 0;            ///< heartbeats whose serial never came
  std::optional<OffsetEstimate> clock;
};

struct TeamWatchConfig {
  std::string self;                ///< our own name, to find the echoes meant for us
  std::vector<std::string> peers;  ///< whose heartbeats are expected
  Duration silent_after{};
};

/// Fed with heartbeats, asked at any time. Time is an argument.
class TeamWatch {
 public:
  explicit TeamWatch(TeamWatchConfig config);

  /// Heartbeats of robots that are not of the team are counted and otherwise ignored; so are those out of order, and
  /// those of a later start as long as the one before is not silent: two of one name are not mistaken for one.
  /// `received` and `received_team` are the same moment. `session`: our own, whose echoes count.
  void heard(const HeartbeatMessage& heartbeat, Stamp received, TeamTime received_team, std::uint64_t session);

  /// Precondition: the peer is one of the configuration's.
  PeerState peer(const std::string& robot, Stamp now) const;
  /// The first peer that is not there, in words: "skip: silent for 0.4 s"; empty: all are.
  std::string missing(Stamp now) const;
  /// What to put into our next heartbeat.
  std::vector<Echo> echoes() const;
  long strangers() const { return strangers_; }
  /// Heartbeats of a second start while the first was there.
  long rivals() const { return rivals_; }

 private:
  struct Peer {
    std::uint64_t session = 0;
    std::uint64_t serial = 0;
    Stamp received{};
    Echo echo;
    ClockOffset clock;
    int restarts = 0;
    long missed = 0;
  };

  TeamWatchConfig config_;
  std::map<std::string, Peer> peers_;
  long strangers_ = 0;
  long rivals_ = 0;
};

}  // namespace hogline::hw::link
