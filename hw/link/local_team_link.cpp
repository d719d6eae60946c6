#include "hw/link/local_team_link.hpp"

#include <array>
#include <utility>

#include "hw/link/message_bounds.hpp"

namespace hogline::hw::link {

class LocalTeam::Member final : public TeamLink {
 public:
  Member(LocalTeam& team, std::string robot, std::uint64_t session) : team_(team), robot_(std::move(robot)) {
    state_.session = session;
  }

  TeamSendResult send(TeamMessage message, Stamp at) override {
    const Origin origin{robot_, state_.session, serials_[message.index()] + 1, team_time(at)};
    std::visit([&](auto& m) { m.origin = origin; }, message);
    if (!within_bounds(message)) return TeamSendResult::refused;
    ++serials_[message.index()];
    ++state_.sent;
    team_.pass_on(*this, message);
    return TeamSendResult::sent;
  }

  std::optional<ReceivedMessage> receive(Stamp now) override {
    if (under_way_.empty() || under_way_.front().received > now) return std::nullopt;
    ReceivedMessage received = std::move(under_way_.front());
    under_way_.pop_front();
    received.received = now;
    ++state_.received;
    return received;
  }

  TeamLinkState state() const override { return state_; }
  TeamTime team_time(Stamp at) const override { return TeamTime{at.time_since_epoch()}; }

  const std::string& robot() const { return robot_; }
  void put(const TeamMessage& message, Stamp due) { under_way_.push_back({message, due}); }

 private:
  LocalTeam& team_;
  std::string robot_;
  TeamLinkState state_;
  std::array<std::uint64_t, std::variant_size_v<TeamMessage>> serials_{};
  std::deque<ReceivedMessage> under_way_;  ///< `received`: when it is there
};

LocalTeam::LocalTeam(const Clock& clock, Duration latency) : clock_(clock), latency_(latency) {}
LocalTeam::~LocalTeam() = default;

TeamLink& LocalTeam::join(const std::string& robot) {
  std::erase_if(members_, [&](const auto& m) { return m->robot() == robot; });
  return *members_.emplace_back(std::make_unique<Member>(*this, robot, ++sessions_));
}

void LocalTeam::pass_on(const Member& from, const TeamMessage& message) {
  for (const auto& member : members_) {
    if (member.get() != &from) member->put(message, clock_.now() + latency_);
  }
}

}  // namespace hogline::hw::link
