// The talk with one client, without sockets: bytes and moments in, bytes out. Lock-step: a client that says anything
// that is not due, too late, too much or not understood has failed for good.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "hw/digital_curling/client_message.hpp"
#include "hw/digital_curling/messages.hpp"
#include "hw/strategist.hpp"

namespace hogline::hw::digital_curling {

struct SessionConfig {
  Team team = Team::first;
  GameIdentity identity;
  GameOffer offer;
  Duration connect_deadline = std::chrono::minutes(5);     ///< from the first step to a client
  Duration greeting_deadline = std::chrono::seconds(10);   ///< from dc to dc_ok
  Duration readiness_deadline = std::chrono::minutes(10);  ///< from is_ready to ready_ok: a program may load much
  std::size_t longest_line = 65536;
  std::size_t most_unread = 16777216;  ///< bytes that a client may leave unread
};

class Session {
 public:
  /// `where` names the place for messages: "127.0.0.1:10000".
  Session(const SessionConfig& config, std::string where);

  void connected(Stamp now);
  void receive(std::string_view bytes, Stamp now);
  /// The client is gone.
  void lost(const std::string& why);
  /// Lets time pass: deadlines and the thinking time.
  void tick(Stamp now);

  /// Precondition: ready.
  void begin(const std::array<std::string, servo::team_count>& names, Stamp now);
  /// Precondition: begun, and not thinking.
  void tell(const servo::GameUpdate& update, Stamp now);
  void note(std::string what) { state_.note = std::move(what); }
  void fail(const std::string& what);

  const StrategistState& state() const { return state_; }
  const std::array<int, 4>& player_order() const { return player_order_; }
  /// What is still to be sent; whoever sends it takes off what went.
  std::string& outgoing() { return outgoing_; }

 private:
  bool failed() const { return state_.phase == StrategistPhase::failed; }
  void say(const std::string& message);
  void wait_for(std::optional<Due> due, Stamp now);
  void take_line(std::string_view line, Stamp now);
  void take(const ClientMessage& message, Stamp now);
  std::string who() const;

  SessionConfig config_;
  std::string where_;
  StrategistState state_;
  std::optional<Stamp> first_step_;
  bool connected_ = false;
  std::optional<Due> due_;
  Stamp since_{};  ///< when what is due became due
  Duration thinking_left_{};
  std::array<int, 4> player_order_{};
  std::string incoming_;
  std::string outgoing_;
};

}  // namespace hogline::hw::digital_curling
