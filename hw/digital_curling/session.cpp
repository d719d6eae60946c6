#include "hw/digital_curling/session.hpp"

#include <cassert>
#include <sstream>
#include <utility>

#include "servo/game/rules.hpp"

namespace hogline::hw::digital_curling {
namespace {

std::string in_words(Duration span) {
  std::ostringstream words;
  words << seconds(span) << " s";
  return words.str();
}

const char* name_of(Due due) { return due == Due::dc_ok ? "dc_ok" : due == Due::ready_ok ? "ready_ok" : "move"; }

}  // namespace

Session::Session(const SessionConfig& config, std::string where) : config_(config), where_(std::move(where)) {}

std::string Session::who() const {
  const std::string name = state_.name.empty() ? "" : " \"" + state_.name + "\"";
  return std::string(team_name(config_.team)) + "'s strategist" + name + " (" + where_ + ")";
}

void Session::fail(const std::string& what) {
  if (failed()) return;
  state_.phase = StrategistPhase::failed;
  state_.decision.reset();
  state_.reason = who() + " " + what;
  due_.reset();
  incoming_.clear();
  outgoing_.clear();
}

void Session::say(const std::string& message) {
  outgoing_ += message;
  outgoing_ += '\n';
  if (outgoing_.size() > config_.most_unread) fail("does not read what it is sent");
}

void Session::wait_for(std::optional<Due> due, Stamp now) {
  due_ = due;
  since_ = now;
}

void Session::connected(Stamp now) {
  connected_ = true;
  wait_for(Due::dc_ok, now);
  say(dc_message(config_.identity));
}

void Session::lost(const std::string& why) {
  if (state_.phase != StrategistPhase::over) fail(why);
}

// A decision counts only when nothing came with it: whoever says two things at once does not keep step.
void Session::receive(std::string_view bytes, Stamp now) {
  const bool listens = state_.phase != StrategistPhase::over && state_.phase != StrategistPhase::late;
  if (failed() || !listens) return;
  incoming_ += bytes;
  for (std::size_t end; !failed() && (end = incoming_.find('\n')) != std::string::npos;) {
    const std::string line = incoming_.substr(0, end);
    incoming_.erase(0, end + 1);
    if (line.size() > config_.longest_line)
      return fail("sent a line of more than " + std::to_string(config_.longest_line) + " bytes");
    take_line(line, now);
  }
  if (failed()) return;
  if (incoming_.size() > config_.longest_line)
    return fail("sent a line of more than " + std::to_string(config_.longest_line) + " bytes");
  if (!due_ && !incoming_.empty()) fail("spoke when it was not its turn");
}

void Session::take_line(std::string_view line, Stamp now) {
  tick(now);  // what comes after its time is late, even when both are seen in the same step
  if (failed() || state_.phase == StrategistPhase::late) return;
  if (!due_) return fail("spoke when it was not its turn");
  const Decoded decoded = decode(line, *due_);
  if (!decoded.message)
    return fail("sent what is not understood as " + std::string(name_of(*due_)) + ": " + decoded.problem);
  take(*decoded.message, now);
}

void Session::take(const ClientMessage& message, Stamp now) {
  if (const auto* hello = std::get_if<DcOk>(&message)) {
    state_.name = hello->name;
    wait_for(Due::ready_ok, now);
    return say(is_ready_message(config_.offer, config_.team));
  }
  if (const auto* ready = std::get_if<ReadyOk>(&message)) {
    player_order_ = ready->player_order;
    state_.phase = StrategistPhase::ready;
    return wait_for(std::nullopt, now);
  }
  state_.decision = StrategistDecision{.move = std::get<servo::GameMove>(message), .thought = now - since_};
  state_.phase = StrategistPhase::decided;
  wait_for(std::nullopt, now);
}

void Session::tick(Stamp now) {
  if (!first_step_) first_step_ = now;
  if (failed()) return;
  if (!connected_) {
    if (now - *first_step_ > config_.connect_deadline)
      fail("did not connect within " + in_words(config_.connect_deadline));
    return;
  }
  if (due_ == Due::dc_ok && now - since_ > config_.greeting_deadline)
    return fail("did not answer dc within " + in_words(config_.greeting_deadline));
  if (due_ == Due::ready_ok && now - since_ > config_.readiness_deadline)
    return fail("was not ready within " + in_words(config_.readiness_deadline));
  if (due_ == Due::move && now - since_ >= thinking_left_) {
    state_.phase = StrategistPhase::late;
    state_.reason = who() + " did not decide within its " + in_words(thinking_left_);
    wait_for(std::nullopt, now);
  }
}

void Session::begin(const std::array<std::string, servo::team_count>& names, Stamp now) {
  assert(state_.phase == StrategistPhase::ready || failed());
  if (failed()) return;
  say(new_game_message(names));
  state_.phase = StrategistPhase::waiting;
  wait_for(std::nullopt, now);
}

void Session::tell(const servo::GameUpdate& update, Stamp now) {
  assert(state_.phase != StrategistPhase::thinking);
  if (failed()) return;
  state_.decision.reset();
  state_.reason.clear();
  say(update_message(update));
  if (failed()) return;
  const auto next = servo::next_team(update.state);
  if (!next) {
    say(game_over_message());
    if (!failed()) state_.phase = StrategistPhase::over;
    return wait_for(std::nullopt, now);
  }
  const bool own = *next == config_.team;
  state_.phase = own ? StrategistPhase::thinking : StrategistPhase::waiting;
  thinking_left_ = update.state.thinking_left[servo::side_of(config_.team)];
  wait_for(own ? std::optional(Due::move) : std::nullopt, now);
}

}  // namespace hogline::hw::digital_curling
