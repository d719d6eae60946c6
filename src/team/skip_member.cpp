#include "src/team/skip_member.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "servo/skip_sheet.hpp"
#include "vision/geometry/sheet.hpp"

namespace hogline {
namespace {

constexpr Duration track_period = std::chrono::milliseconds(100);
constexpr Duration answer_limit = std::chrono::milliseconds(1500);  // five times what a silent predecessor counts for
// What a release by the thrower's own word is off (doc/performance.md: its campaigns), and what two machines differ in
// where the far tee is.
constexpr double release_place_sigma_m = 0.03;
constexpr double release_velocity_sigma_mps = 0.02;

double signed_spin(const servo::ShotOrder& order) {
  return order.curl == servo::Curl::counter_clockwise ? order.spin_radps : -order.spin_radps;
}

std::string word(Team team) { return team == Team::first ? "first" : team == Team::second ? "second" : "unknown"; }

std::string word(servo::StoneFate fate) {
  constexpr std::array<const char*, 5> words{"at_rest", "hogged", "sideline", "through", "lost"};
  return words[static_cast<std::size_t>(fate)];
}

std::array<double, 3> values(const PlaceCovariance& c) { return {c.xx_m2, c.xy_m2, c.yy_m2}; }

std::optional<double> value(const std::optional<servo::Measured>& m) {
  return m ? std::optional(m->value) : std::nullopt;
}

servo::ReleaseSignal signal_of(const hw::ReleaseMessage& m, Stamp at, Team team) {
  const double thrower_y_m = vision::rules::tee_to_hog_m - m.hog_distance_m;
  return {.stamp = at,
          .stone = {-m.lateral_m, vision::rules::tee_to_tee_m - thrower_y_m, m.speed_mps * std::sin(m.heading_rad),
                    -m.speed_mps * std::cos(m.heading_rad), m.spin_radps},
          .place_sigma_m = release_place_sigma_m,
          .velocity_sigma_mps = release_velocity_sigma_mps,
          .team = team};
}

}  // namespace

SkipMember::SkipMember(const config::SkipRig& rig, const SkipDevices& devices, Seers seers, hw::TeamLink& link)
    : rig_(rig), devices_(devices), seers_(std::move(seers)), link_(link, "skip", "thrower") {}

void SkipMember::step(Stamp now, Duration dt) {
  link_.step(now);
  listen(now);
  if (held_) send_order(now);
  if (loop_) {
    loop_->step(now, dt);
    tell(now);
  } else {
    devices_.head.step(now);
  }
}

void SkipMember::begin(const servo::IceEstimate& ice, Stamp now) {
  if (stopping_) stop_thrower(false, {}, now);
  stopping_ = board_told_ = outcome_told_ = false;
  held_.reset();
  ordered_ = OrderPhase::none;
  why_.clear();
  release_.reset();
  released_at_.reset();
  if (devices_.head.state().error) devices_.head.rearm();
  if (devices_.near.error()) devices_.near.rearm();
  if (devices_.far.error()) devices_.far.rearm();
  seer_ = seers_();
  loop_ = std::make_unique<SkipLoop>(devices_, *seer_, servo::Skip(rig_.skip, servo::from_other_end(ice), now));
}

bool SkipMember::has_looked() const {
  return loop_ && loop_->skip().state() > servo::SkipState::look && loop_->skip().state() < servo::SkipState::stopped;
}

bool SkipMember::waits() const { return loop_ && loop_->skip().state() == servo::SkipState::wait; }

void SkipMember::order(const servo::ShotOrder& order, std::uint32_t shot, Team team, Stamp now) {
  team_ = team;
  loop_->expect(signed_spin(order));
  why_ = "the thrower does not answer";
  hw::ShotOrderMessage message;
  message.shot = shot;
  message.speed_mps = order.speed_mps;
  message.heading_rad = order.heading_rad;
  message.spin_radps = signed_spin(order);
  held_ = Held{message, now};
  ordered_ = OrderPhase::sent;
  send_order(now);
}

// An order that the thrower would not take for ours, or could not tell the age of, would be lost.
void SkipMember::send_order(Stamp now) {
  const bool over_meanwhile = over();
  if (!over_meanwhile && !link_.answered(now) && now - held_->since < answer_limit) return;
  hw::ShotOrderMessage message = std::exchange(held_, std::nullopt)->message;
  if (over_meanwhile || !link_.answered(now)) {
    ordered_ = OrderPhase::refused;
    const std::string missing = link_.missing(now);
    why_ = over_meanwhile    ? "the skip: " + loop_->skip().report().reason
           : missing.empty() ? "the thrower answers to another skip, or not yet to this one"
                             : missing;
    return;
  }
  message.thrower_session = thrower_session_ = link_.peer_session(now);
  const auto sent = link_.send(message, now);
  ordered_ = sent == hw::TeamSendResult::sent ? OrderPhase::sent : OrderPhase::refused;
  if (ordered_ == OrderPhase::sent) ++orders_;
  if (ordered_ == OrderPhase::refused) why_ = "the order was not sent: the link does not take it";
}

void SkipMember::listen(Stamp now) {
  while (const auto received = link_.receive(now)) {
    if (hw::origin_of(received->message).robot != "thrower") continue;
    if (const auto* state = std::get_if<hw::ThrowerStateMessage>(&received->message)) take(*state);
    if (const auto* release = std::get_if<hw::ReleaseMessage>(&received->message)) take(*release, now);
  }
}

bool SkipMember::order_is_open() const { return ordered_ == OrderPhase::sent || ordered_ == OrderPhase::throwing; }

bool SkipMember::thrower_armed(Stamp now) const {
  return thrower_ && thrower_->armed && thrower_->origin.session == link_.peer_session(now) && missing(now).empty();
}

void SkipMember::take(const hw::ThrowerStateMessage& state) {
  thrower_ = state;
  using hw::ThrowerPhase;
  if (!order_is_open()) return;
  if (!held_ && state.origin.session > thrower_session_) {
    ordered_ = OrderPhase::refused;
    why_ = "the thrower was started anew: it knows of no order";
    return;
  }
  if (state.order_serial != orders_ || state.origin.session != thrower_session_) return;
  if (state.phase == ThrowerPhase::stopped || state.phase == ThrowerPhase::fault) {
    ordered_ = OrderPhase::refused;
    why_ = state.reason;
  } else if (state.phase != ThrowerPhase::idle) {
    ordered_ = OrderPhase::throwing;
  }
}

void SkipMember::take(const hw::ReleaseMessage& release, Stamp now) {
  const auto at = link_.local(release.origin.stamp, now);
  if (release.order_serial != orders_ || release.origin.session != thrower_session_ || release_ || !at) return;
  release_ = release;
  released_at_ = at;
  ordered_ = OrderPhase::released;
  if (loop_) loop_->hear(signal_of(release, *at, team_));
}

// What has been ordered is thrown only as long as somebody will follow it.
void SkipMember::tell(Stamp now) {
  if (has_looked() && !board_told_) tell_board(now);
  if (loop_->skip().state() == servo::SkipState::follow && now >= next_track_) tell_track(now);
  if (over() && !outcome_told_) tell_outcome(now);
  if (over() && !held_ && order_is_open() && !stopping_)
    stop_thrower(true, "the skip: " + loop_->skip().report().reason, now);
}

void SkipMember::tell_board(Stamp now) {
  board_told_ = true;
  hw::BoardMessage board;
  board.ok = true;
  for (const StoneSighting& s : loop_->skip().diagnosis().standing) {
    board.stones.push_back({s.x_m, s.y_m, values(s.covariance), word(s.team)});
  }
  link_.send(board, now);
}

void SkipMember::tell_track(Stamp now) {
  const servo::SkipDiagnosis& known = loop_->skip().diagnosis();
  if (!known.thrown) return;
  next_track_ = now + track_period;
  const servo::SlidingStone& s = *known.thrown;
  hw::StoneTrackMessage track;
  track.order_serial = orders_;
  track.x_m = s.x_m;
  track.y_m = s.y_m;
  track.vx_mps = s.vx_mps;
  track.vy_mps = s.vy_mps;
  track.place_covariance_m2 = values(known.thrown_covariance);
  link_.send(track, now);
}

void SkipMember::tell_outcome(Stamp now) {
  outcome_told_ = true;
  if (!release_) return;
  const servo::SkipReport& report = loop_->skip().report();
  const auto& stones = report.result.stones;
  const auto thrown = std::ranges::find(stones, true, &servo::StoneOutcome::thrown);
  hw::OutcomeMessage outcome;
  outcome.order_serial = orders_;
  outcome.ok = thrown != stones.end();
  outcome.reason = report.reason;
  if (outcome.ok) {
    outcome.fate = word(thrown->fate);
    outcome.x_m = thrown->x_m;
    outcome.y_m = thrown->y_m;
  }
  outcome.hog_to_hog_s = value(report.result.hog_to_hog_s);
  outcome.hog_to_rest_s = value(report.result.hog_to_rest_s);
  outcome.curl_m = value(report.result.curl_m);
  outcome.collisions = static_cast<std::uint32_t>(report.result.collisions.size());
  link_.send(outcome, now);
}

void SkipMember::stop_thrower(bool pressed, const std::string& reason, Stamp now) {
  stopping_ = pressed;
  hw::EmergencyStopMessage stop;
  stop.pressed = pressed;
  stop.reason = reason;
  link_.send(stop, now);
}

}  // namespace hogline
