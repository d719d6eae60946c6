#include "src/live/live_throws.hpp"

#include <fmt/format.h>

#include <utility>

#include "servo/skip_sheet.hpp"
#include "src/team/seen_trajectory.hpp"
#include "src/team/turn_order.hpp"

namespace hogline {
namespace {

using game::ThrowEnd;
using game::ThrowReport;
using servo::side_of;

constexpr int most_attempts = 3;
constexpr Duration throw_limit = std::chrono::seconds(120);
constexpr Duration rest_limit = std::chrono::seconds(45);  // no stone runs longer
constexpr Duration count_limit = std::chrono::seconds(30);

}  // namespace

LiveThrows::LiveThrows(LiveSkip& skip, LoopCalls& calls, const servo::ThrowerSkill& skill, const servo::IceModel& ice,
                       Tell tell)
    : skip_(skip), calls_(calls), skill_(skill), ice_(ice), tell_(std::move(tell)) {}

void LiveThrows::start(const game::Turn& turn, Stamp now) {
  turn_ = turn;
  report_ = {};
  followed_.reset();
  attempts_ = 0;
  tell_("turn",
        fmt::format("stone {} of team{}: lay it before the thrower, and arm it", turn.stone + 1, side_of(turn.team)));
  prepare(now);
}

std::optional<ThrowReport> LiveThrows::step(Stamp now) {
  if (phase_ == Phase::idle) return std::nullopt;
  const auto view = calls_.ask([&] { return skip_.view(now); });
  if (!view) return closed(ThrowEnd::failed, "the skip's program ends");
  switch (phase_) {
    case Phase::idle:
      return std::nullopt;
    case Phase::preparing:
      if (view->over) return not_thrown("the skip: " + view->report.reason, now);
      return view->waits && view->thrower_armed ? order(*view, now) : std::nullopt;
    case Phase::ordered:
      return ordered(*view, now);
    case Phase::following:
      if (!view->over) return std::nullopt;
      followed_ = view->report;
      phase_ = Phase::settling;
      return std::nullopt;
    case Phase::settling:
      if (followed_->ok || now - since_ > rest_limit) begin_look(Phase::counting, now);
      return std::nullopt;
    case Phase::counting:
      return counting(*view, now);
  }
  return std::nullopt;
}

void LiveThrows::begin_look(Phase phase, Stamp now) {
  phase_ = phase;
  since_ = now;
  calls_.ask([&] { return skip_.begin(ice_.estimate(), now), true; });
}

std::optional<ThrowReport> LiveThrows::prepare(Stamp now) {
  ++attempts_;
  begin_look(Phase::preparing, now);
  return std::nullopt;
}

std::optional<ThrowReport> LiveThrows::order(const SkipView& view, Stamp now) {
  TurnOrder order = order_of(turn_, view.standing, view.sheet_width_m, skill_, ice_);
  names_ = std::move(order.names);
  for (const std::string& remark : order.remarks) tell_("remark", remark);
  report_.mapped = order.mapped;
  if (!order.refused.empty()) return closed(ThrowEnd::refused, order.refused);
  report_.order = order.order;
  const auto refused = calls_.ask([&] { return skip_.order(report_.order, ++shot_, turn_.team, now); });
  if (refused && !refused->empty()) return not_thrown(*refused, now);
  phase_ = Phase::ordered;
  since_ = now;
  return std::nullopt;
}

std::optional<ThrowReport> LiveThrows::ordered(const SkipView& view, Stamp now) {
  if (view.ordered == OrderPhase::released) {
    phase_ = Phase::following;
    since_ = now;
    return std::nullopt;
  }
  if (view.ordered == OrderPhase::refused) return not_thrown(view.why, now);
  if (view.over) return not_thrown("the skip: " + view.report.reason, now);
  return now - since_ > throw_limit ? not_thrown("the thrower does not come to an end", now) : std::nullopt;
}

std::optional<ThrowReport> LiveThrows::not_thrown(const std::string& why, Stamp now) {
  tell_("not thrown", why);
  return attempts_ < most_attempts ? prepare(now) : closed(ThrowEnd::failed, why);
}

std::optional<ThrowReport> LiveThrows::counting(const SkipView& view, Stamp now) {
  if (view.has_looked) return ended(view);
  if (!view.over && now - since_ < count_limit) return std::nullopt;
  tell_("remark", "not counted: " + (view.over ? view.report.reason : "too late"));
  if (!followed_->ok) return closed(ThrowEnd::failed, "the stones were neither followed to rest nor counted");
  return ended(view);
}

ThrowReport LiveThrows::ended(const SkipView& view) {
  SeenThrow seen{.before = turn_.board,
                 .thrown = {side_of(turn_.team), turn_.stone},
                 .names = names_,
                 .followed = followed_->result,
                 .counted = std::nullopt};
  if (view.has_looked) seen.counted = view.standing;
  StonesAfter after = stones_after(seen);
  report_.seen = after.stones;
  report_.trajectory = seen_trajectory(seen, after.stones.lying);
  for (const std::string& remark : after.remarks) tell_("remark", remark);
  if (followed_->result.track) ice_.learn(servo::from_other_end(*followed_->result.track));
  return closed(ThrowEnd::thrown, {});
}

ThrowReport LiveThrows::closed(ThrowEnd end, const std::string& reason) {
  report_.end = end;
  report_.reason = reason;
  phase_ = Phase::idle;
  return report_;
}

}  // namespace hogline
