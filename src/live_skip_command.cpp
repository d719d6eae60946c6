#include "src/live_skip_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <thread>

#include "hw/link/dds_team_link.hpp"
#include "src/config/config_error.hpp"
#include "src/config/device_rig.hpp"
#include "src/exit_status.hpp"
#include "src/live/input_lines.hpp"
#include "src/live/live_skip.hpp"
#include "src/live/loop_calls.hpp"
#include "src/live/order_words.hpp"
#include "src/live/process.hpp"
#include "src/live_game.hpp"
#include "src/skip/skip_vision.hpp"
#include "src/team/robots_throw.hpp"

namespace hogline {
namespace {

hw::link::LinkConfig link_of(const std::string& path) {
  const config::DeviceRig rig = config::load_device_rig(path);
  if (!rig.link) throw config::ConfigError(path, 0, "link", "", "missing; the skip orders its shots there");
  if (rig.link->robot != "skip" || rig.link->peers != std::vector<std::string>{"thrower"}) {
    throw config::ConfigError(path, 0, "link.robot", rig.link->robot,
                              "must be skip, and its peer thrower: who orders, and who throws");
  }
  return *rig.link;
}

/// What the operator says, and what becomes of it.
class Operator {
 public:
  Operator(LiveSkip& skip, LiveGame* game) : skip_(skip), game_(game) {}

  /// Empty: it is done, or on its way.
  std::string obey(const std::string& line, Stamp now) {
    const bool playing = game_ != nullptr && game_->playing();
    if (line == "quit") return quit_ = true, "";
    if (line == "play") return game_ == nullptr ? "no game: --thrower-rig says what the thrower can" : game_->play();
    if (line == "stop" && playing) return game_->stop(), "";
    if (line == "stop") return "no game is played";
    if (playing) return "a game is played: stop ends it";
    if (line == "begin") return skip_.begin(now);
    if (line == "order" || line.starts_with("order ")) return order(line, now);
    return "'" + line + "': there are begin, order, play, stop, quit";
  }
  bool wants_to_quit() const { return quit_; }

 private:
  std::string order(const std::string& line, Stamp now) {
    const auto shot = read_order(line);
    if (!shot) return "'" + line + "': " + order_form();
    return skip_.order(*shot, ++shots_, Team::unknown, now);
  }

  LiveSkip& skip_;
  LiveGame* game_;
  std::uint32_t shots_ = 0;
  bool quit_ = false;
};

/// However the loop ends: whoever asks it then is not kept waiting.
struct ClosedAtTheEnd {
  explicit ClosedAtTheEnd(LoopCalls& of) : calls(of) {}
  ~ClosedAtTheEnd() { calls.close(); }
  ClosedAtTheEnd(const ClosedAtTheEnd&) = delete;
  ClosedAtTheEnd& operator=(const ClosedAtTheEnd&) = delete;
  LoopCalls& calls;
};

void tell_skip(const char* event, const std::string& what) { tell("skip", event, what); }

/// The loop itself: skip, its operator's words, and what the game's thread asks.
void run_control(LiveSkip& skip, LiveGame* game, LoopCalls& calls, Duration period, ServiceManager& services) {
  const ClosedAtTheEnd closed(calls);
  const hw::SteadyClock clock;
  InputLines input;
  Operator person(skip, game);
  Stamp last = clock.now();
  for (Stamp due = last + period; !person.wants_to_quit() && !asked_to_end(); due += period) {
    std::this_thread::sleep_until(due);
    const Stamp now = clock.now();
    skip.step(now, now - last);
    services.alive(now);
    last = now;
    due = std::max(due, now - period);  // what is lost is lost
    calls.serve();
    if (game != nullptr) game->news(tell_skip);
    const auto line = input.line();
    const std::string refusal = line ? person.obey(*line, now) : std::string();
    if (!refusal.empty()) tell("skip", "refused", refusal);
  }
}

}  // namespace

int run_live_skip(const LiveSkipOptions& options) {
  listen_for_the_end();
  check_seats(options.table);
  const hw::link::LinkConfig link_config = link_of(options.rig);
  const config::SkipRig rig = config::load_skip_rig(options.rig);
  const hw::SteadyClock clock;
  ServiceManager services;
  const bool first = run_first(control_priority);  // the link's threads, too: control must not wait for one of them
  hw::link::DdsTeamLink link(link_config, clock.now(),
                             hw::TeamTime{std::chrono::system_clock::now().time_since_epoch()});
  SteelSkip robot(rig, clock);
  LiveSkip skip(
      rig, robot, link, clock, [&rig] { return std::make_unique<SkipVision>(rig); }, tell_skip);
  LoopCalls calls;
  std::optional<LiveGame> game;
  if (!options.thrower_rig.empty()) {
    const servo::ThrowerSkill skill = skill_of(config::load_thrower_rig(options.thrower_rig));
    game.emplace(options.table, rig.rig.near_camera->sheet.width_m, skill, skip, calls);
  }
  tell("skip", "session",
       fmt::format("{}, {}", link.state().session, first ? "runs first" : "runs as other programs do"));
  services.ready("waits for its operator");
  run_control(skip, game ? &*game : nullptr, calls, rig.head.timing.control_period, services);
  robot.head().stop();
  robot.head().step(clock.now());
  services.stopping();
  tell("skip", "end", "");
  return ExitStatus::success;
}

}  // namespace hogline
