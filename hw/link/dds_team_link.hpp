// The team's link on Eclipse Cyclone DDS, by ROS 2's wire rules: what a ROS 2 machine calls /hogline/... is here.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "hw/link/dds_domain.hpp"
#include "hw/link/link_config.hpp"
#include "hw/link/link_error.hpp"
#include "hw/team_link.hpp"

namespace hogline::hw::link {

/// How often DDS itself noticed that somebody's heartbeats are late or that somebody is gone. TeamWatch says who.
struct DdsAlarms {
  long deadlines_missed = 0;
  long writers_lost = 0;
};

/// DDS has threads of its own; these calls are for one thread. Closed by the destructor.
class DdsTeamLink final : public TeamLink {
 public:
  /// `utc_now`: the wall clock at `now`; read once, see TeamTime. It also makes the session's number.
  /// Throws LinkError.
  DdsTeamLink(const LinkConfig& config, Stamp now, TeamTime utc_now);
  ~DdsTeamLink() override;
  DdsTeamLink(const DdsTeamLink&) = delete;
  DdsTeamLink& operator=(const DdsTeamLink&) = delete;

  TeamSendResult send(TeamMessage message, Stamp at) override;
  std::optional<ReceivedMessage> receive(Stamp now) override;
  TeamLinkState state() const override { return state_; }
  TeamTime team_time(Stamp at) const override { return utc_start_ + (at - start_); }

  /// Other participants' writers of the kind of message that stands at `kind` in TeamMessage.
  int matched_writers(std::size_t kind) const;
  int matched_readers(std::size_t kind) const;
  /// A message of this kind has come in and was not read yet.
  bool waiting(std::size_t kind) const;
  DdsAlarms alarms() const;

 private:
  struct Ends {
    std::int32_t writer = 0;
    std::int32_t reader = 0;
    std::uint64_t serial = 0;
  };

  void open(const LinkConfig& config);
  void latch(Stamp now, std::string what);
  std::optional<TeamMessage> take(std::size_t kind);
  bool may_say(std::size_t kind, std::uint64_t writer, const TeamMessage& message);

  std::string robot_;
  Stamp start_;
  TeamTime utc_start_;
  TeamLinkState state_;
  std::shared_ptr<DdsDomain> domain_;
  std::int32_t participant_ = 0;
  std::array<Ends, std::variant_size_v<TeamMessage>> ends_{};
  bool secure_;
  std::map<std::uint64_t, std::vector<std::string>> names_;  ///< of each writer that was heard, when secure
};

}  // namespace hogline::hw::link
