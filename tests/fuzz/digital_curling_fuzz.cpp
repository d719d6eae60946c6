// Digital Curling: any bytes of a client, in pieces and with time going on, into a session that is in any of its
// states.
#include <cmath>
#include <string>
#include <string_view>

#include "hw/digital_curling/session.hpp"
#include "servo/game/rules.hpp"
#include "tests/fuzz/require.hpp"

namespace hogline::fuzz {
namespace {

using namespace std::chrono_literals;
using namespace hogline::hw;
using digital_curling::Session;
using digital_curling::SessionConfig;

SessionConfig config() {
  SessionConfig config;
  config.identity = {"game", "2026-11-22T10:05:00+00:00"};
  config.offer.setting.ends = 1;
  config.offer.setting.thinking = {10s, 10s};
  config.longest_line = 300;
  return config;
}

void check(const StrategistState& state) {
  require(state.decision.has_value() == (state.phase == StrategistPhase::decided), "a decision is there when decided");
  const bool ended = state.phase == StrategistPhase::failed || state.phase == StrategistPhase::late;
  require(!ended || !state.reason.empty(), "an end has a reason");
  for (const char c : state.reason) require(c != '\n' && c != '\0', "a reason is one line");
  if (!state.decision) return;
  if (const auto* shot = std::get_if<servo::HackShot>(&state.decision->move))
    require(std::abs(shot->vx_mps) <= 10.0 && std::abs(shot->vy_mps) <= 10.0, "a shot is in range");
  require(state.decision->thought >= Duration::zero() && state.decision->thought < 10s, "a decision is in time");
}

/// A game of turns in which every throw goes away.
void advance(Session& session, servo::GameState& game, Stamp now) {
  const auto& state = session.state();
  if (state.phase == StrategistPhase::ready) session.begin({"a", "b"}, now);
  const bool told = state.phase == StrategistPhase::waiting || state.phase == StrategistPhase::decided;
  if (!told || !servo::next_team(game)) return;
  session.tell({game, servo::LastMove{servo::Concession{}, false, {}}}, now);
  game = servo::judge(game, {.lying = game.board}, config().offer.setting).state;
}

}  // namespace
}  // namespace hogline::fuzz

// Each piece begins with its length; 250 and more let time pass instead, in seconds beyond that.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hogline::fuzz;
  Session session(config(), "here");
  hogline::servo::GameState game = hogline::servo::new_game(config().offer.setting);
  hogline::Stamp now{std::chrono::seconds(1)};
  session.connected(now);
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  while (!rest.empty()) {
    const auto length = static_cast<unsigned char>(rest.front());
    rest.remove_prefix(1);
    now += 10ms;
    if (length >= 250) {
      now += std::chrono::seconds(length - 249);
      session.tick(now);
    } else {
      const std::string_view piece = rest.substr(0, length);
      session.receive(piece, now);
      rest.remove_prefix(piece.size());
    }
    check(session.state());
    advance(session, game, now);
    session.outgoing().clear();
  }
  return 0;
}
