#include "src/live/live_throws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "servo/skip_sheet.hpp"
#include "src/team/seen_trajectory.hpp"
#include "src/team/turn_order.hpp"

namespace hogline {
namespace {

using game::ThrowEnd;
using game::ThrowReport;
using servo::side_of;

bool all_seen_to_rest(const servo::SkipReport& report) {
  return report.ok && std::ranges::none_of(report.result.stones, [](const servo::StoneOutcome& stone) {
           return stone.fate == servo::StoneFate::lost;
         });
}

constexpr int most_attempts = 3;
constexpr Duration throw_limit = std::chrono::seconds(120);
constexpr Duration rest_limit = std::chrono::seconds(45);  // no stone runs longer
constexpr Duration count_limit = std::chrono::seconds(30);
constexpr Duration look_limit = std::chrono::seconds(60);
constexpr Duration look_pause = std::chrono::seconds(3);  // two boots of the head's drives

}  // namespace

LiveThrows::LiveThrows(LiveSkip& skip, LoopCalls& calls, const servo::ThrowerSkill& skill, const servo::IceModel& ice,
                       Tell tell)
    : skip_(skip), calls_(calls), skill_(skill), ice_(ice), tell_(std::move(tell)) {}

void LiveThrows::start(const game::Turn& turn, Stamp now) {
  turn_ = turn;
  report_ = {};
  followed_.reset();
  attempts_ = 0;
  cancelled_.clear();
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
      return preparing(*view, now);
    case Phase::ordered:
      return ordered(*view, now);
    case Phase::following:
      if (!view->over) return std::nullopt;
      followed_ = view->report;
      phase_ = Phase::settling;
      return std::nullopt;
    case Phase::settling:
      // Nobody counts stones that run: one that was lost from sight does so until no stone can any more.
      if (!all_seen_to_rest(*followed_) && now - since_ <= rest_limit) return std::nullopt;
      settled_ = now;
      begin_look(Phase::counting, now);
      return std::nullopt;
    case Phase::counting:
      return counting(*view, now);
  }
  return std::nullopt;
}

void LiveThrows::begin_look(Phase phase, Stamp now) {
  phase_ = phase;
  since_ = now;
  not_begun_ = calls_.ask([&] { return skip_.begin(ice_.estimate(), now); }).value_or(std::string());
}

std::optional<ThrowReport> LiveThrows::prepare(Stamp now) {
  ++attempts_;
  lost_since_.reset();
  begin_look(Phase::preparing, now);
  return std::nullopt;
}

std::optional<ThrowReport> LiveThrows::preparing(const SkipView& view, Stamp now) {
  if (!cancelled_.empty()) return closed(ThrowEnd::failed, cancelled_);
  if (!not_begun_.empty()) return closed(ThrowEnd::failed, "the skip does not look: " + not_begun_);
  // Given up as its jaws opened: it is gone all the same.
  if (view.ordered == OrderPhase::released) return released(now);
  if (view.over) return look_again("the skip: " + view.report.reason, now);
  if (view.waits) lost_since_.reset();
  return view.waits && view.thrower_armed ? order(view, now) : std::nullopt;
}

// Nothing was ordered: a head or a camera that was lost is given time to come back, and no attempt is spent on it.
std::optional<ThrowReport> LiveThrows::look_again(const std::string& why, Stamp now) {
  if (!lost_since_) lost_since_ = now;
  if (now - *lost_since_ > look_limit) return closed(ThrowEnd::failed, why);
  begin_again(why, now);
  return std::nullopt;
}

void LiveThrows::begin_again(const std::string& why, Stamp now) {
  if (now - since_ < look_pause) return;
  tell_("remark", "looks again: " + why);
  begin_look(phase_, now);
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
  if (view.ordered == OrderPhase::released) return released(now);
  if (view.ordered == OrderPhase::refused) return not_thrown(view.why, now);
  // A skip that can not follow any more has told the thrower to stop: what that answers says whether the stone is gone.
  return now - since_ > throw_limit ? not_thrown("the thrower does not come to an end", now) : std::nullopt;
}

std::optional<ThrowReport> LiveThrows::released(Stamp now) {
  phase_ = Phase::following;
  since_ = now;
  return std::nullopt;
}

std::optional<ThrowReport> LiveThrows::not_thrown(const std::string& why, Stamp now) {
  tell_("not thrown", why);
  if (!cancelled_.empty()) return closed(ThrowEnd::failed, cancelled_);
  return attempts_ < most_attempts ? prepare(now) : closed(ThrowEnd::failed, why);
}

std::optional<ThrowReport> LiveThrows::counting(const SkipView& view, Stamp now) {
  if (view.has_looked) return ended(view);
  if (now - settled_ < count_limit) {
    if (view.over) begin_again("the skip: " + view.report.reason, now);
    return std::nullopt;
  }
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
  if (seen.counted) report_.seen_sigma_m = house_sigma_m(*seen.counted);
  report_.trajectory = seen_trajectory(seen, after.stones.lying);
  for (const std::string& remark : after.remarks) tell_("remark", remark);
  learn(after.stones);
  return closed(ThrowEnd::thrown, {});
}

// A track that a touch has bent without being seen to is not free to its end: it says nothing of the ice.
void LiveThrows::learn(const servo::ThrownStones& seen) {
  const servo::ThrowResult& result = followed_->result;
  const bool touch_not_seen = seen.struck && result.collisions.empty();
  if (!result.track || touch_not_seen) return tell_("ice", "nothing learnt of it from this stone");
  const servo::ThrowFit fit = ice_.learn(servo::from_other_end(*result.track));
  if (!fit.ok) return tell_("ice", "nothing learnt of it from this stone: " + fit.reason);
  const servo::IceEstimate& ice = ice_.estimate();
  tell_("ice", fmt::format("learnt from {} stones: friction {:.3f}, curl {:.3f}, slope {:+.2e} m/s2", ice.throws,
                           ice.friction_scale, ice.curl_gain, ice.lateral_mps2));
}

void LiveThrows::cancel(const std::string& reason) { cancelled_ = reason; }

ThrowReport LiveThrows::closed(ThrowEnd end, const std::string& reason) {
  report_.end = end;
  report_.reason = reason;
  phase_ = Phase::idle;
  return report_;
}

}  // namespace hogline
