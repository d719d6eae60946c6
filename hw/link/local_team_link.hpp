// The team's link within one process, in stepped time: for whole turns on the simulated rink. Messages pass as they
// pass on the wire: bounded, numbered and stamped by their sender, late by what a network takes, never one's own.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "hw/clock.hpp"
#include "hw/team_link.hpp"

namespace hogline::hw::link {

class LocalTeam {
 public:
  /// The clock must outlive the team. All its members' clocks are this one.
  LocalTeam(const Clock& clock, Duration latency);
  LocalTeam(const LocalTeam&) = delete;
  LocalTeam& operator=(const LocalTeam&) = delete;
  ~LocalTeam();

  /// A robot joins, or is started anew under its name: its sessions grow. The team keeps the link.
  TeamLink& join(const std::string& robot);

 private:
  class Member;
  void pass_on(const Member& from, const TeamMessage& message);

  const Clock& clock_;
  Duration latency_;
  std::uint64_t sessions_ = 0;
  std::vector<std::unique_ptr<Member>> members_;
};

}  // namespace hogline::hw::link
