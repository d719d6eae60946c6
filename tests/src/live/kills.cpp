// Kills or stops the programs of a team at random moments of throws, and reads from the rink's truth what became of the
// robot:  hogline_kills PROGRAM COUNT SEED [FIRST]
// The first is 0 unless it is said; whom a signal strikes, and which, goes by its number.
// Prints a table; its exit status is 1 when the robot did not stop in time, let a stone go that it should have kept,
// moved on its own afterwards, or could not be set up again. What a machine that was late did not let happen is told
// apart.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <random>
#include <thread>

#include "tests/src/live/team_scene.hpp"

using namespace hogline;
using namespace hogline::live_test;

namespace {

// From the signal until body, wheels and arm stand: the longest that anybody needs to notice (the link's deadline of
// 0.3 s, the drives' 0.1 s), the ramp of 2.5 m/s2 from full speed, the fingers' and the arm's way, and what a busy
// machine adds.
constexpr Duration stop_limit = 2500ms;
// A stone that is let go so soon after the signal was let go by a robot that could not yet know.
constexpr Duration notice_limit = 400ms;
constexpr Duration still_for = 1500ms;

struct Kill {
  const char* whom;
  int signal;
  Duration stopped_for;  ///< SIGSTOP: until SIGCONT
  const char* state;     ///< of the throw
  Duration after;        ///< its beginning
};

struct Result {
  Kill kill{};
  bool began = false;  ///< the throw reached the state
  double speed_mps = 0.0;
  bool moved = false;            ///< when the signal came
  std::optional<double> stop_s;  ///< until all stood
  double way_m = 0.0;
  bool released_before = false;
  bool released_after = false;
  bool still = false;
  std::string said;
  std::string problem;
  std::string not_shown;  ///< what did not come about, on a machine that was late
};

// Something did not come about: a problem, unless the machine was late.
void did_not(TeamScene& scene, Result& r, const std::string& what, Stamp since) {
  (scene.was_late(since, now()) ? r.not_shown : r.problem) = what;
}

template <typename Value, std::size_t count>
Value pick(const std::array<Value, count>& of, std::mt19937& random) {
  return of[std::uniform_int_distribution<std::size_t>(0, count - 1)(random)];
}

Kill draw(std::mt19937& random, int number) {
  struct Part {
    const char* state;
    double span_s;
  };
  constexpr std::array<Part, 2> games{{{"asked", 4.0}, {"throwing", 11.0}}};
  constexpr std::array<Part, 8> parts{{{"unfold", 1.5},
                                       {"rehearse", 0.9},
                                       {"measure", 0.9},
                                       {"align", 1.2},
                                       {"fold", 1.5},
                                       {"run", 4.8},
                                       {"run", 4.8},
                                       {"run", 4.8}}};
  constexpr std::array<const char*, 4> whom{"thrower", "skip", "rink", "strategist"};
  const auto share = [&random](double least, double most) {
    return from_seconds(std::uniform_real_distribution<double>(least, most)(random));
  };
  const char* who = whom[static_cast<std::size_t>(number) % whom.size()];
  // Each signal comes to a strategist that thinks as often as to one whose shot is being thrown.
  const Part part = who == std::string("strategist") ? games[static_cast<std::size_t>(number) / 8 % games.size()]
                                                     : pick(parts, random);
  return {.whom = who,
          .signal = number / 4 % 2 == 0 ? SIGKILL : SIGSTOP,
          .stopped_for = share(1.0, 3.0),
          .state = part.state,
          .after = share(0.0, part.span_s)};
}

bool is_strategist(const Kill& kill) { return kill.whom == std::string("strategist"); }

Member& member(TeamScene& scene, const std::string& name) {
  if (name == "thrower") return scene.thrower();
  if (name == "strategist") return scene.strategist();
  return name == "skip" ? scene.skip() : scene.rink();
}

// The last moment of the truth that is not after `at`.
const TrueMoment& moment_at(const std::vector<TrueMoment>& truth, Stamp at) {
  const auto next = std::ranges::upper_bound(truth, at, {}, &TrueMoment::at);
  return next == truth.begin() ? truth.front() : *std::prev(next);
}

// When the robot stood, and stood for a while: nothing while it moves, or nothing is known.
std::optional<Stamp> stood_since(const std::vector<TrueMoment>& truth, Stamp from) {
  std::optional<Stamp> stood;
  for (auto m = std::ranges::lower_bound(truth, from, {}, &TrueMoment::at); m != truth.end(); ++m) {
    if (m->moves) {
      stood.reset();
    } else if (!stood) {
      stood = m->at;
    }
  }
  return stood && !truth.empty() && truth.back().at - *stood >= still_for ? stood : std::nullopt;
}

// An arm that is unfolded already skips a state.
bool not_before(const std::string& state, const std::string& other) {
  constexpr std::array<const char*, 9> order{"unfold", "rehearse", "measure", "align",  "fold",
                                             "run",    "release",  "brake",   "stopped"};
  return std::ranges::find(order, state) >= std::ranges::find(order, other);
}

// A busy machine may hold a loop up until a drive gives up its master: then the operator presses again, for so long.
constexpr Duration attempts_limit = 40s;

std::optional<Stamp> throw_began(TeamScene& scene) {
  const Stamp end = now() + attempts_limit;
  while (now() < end) {
    const Stamp begin = now();
    if (scene.skip_waits()) {
      scene.hand().start();
      wait_until([&] { return scene.thrower().told_since(begin, "armed").has_value(); }, 20s);
      scene.skip().say("order 2.1 0 1.5");
      wait_until(
          [&] {
            return scene.thrower().told_since(begin, "throwing") || scene.thrower().told_since(begin, "disarmed");
          },
          40s);
    }
    if (scene.thrower().told_since(begin, "throwing")) return begin;
    scene.hand().end();
    scene.skip().end();
    if (!scene.set_up()) return std::nullopt;
  }
  return std::nullopt;
}

bool throw_reaches(TeamScene& scene, const Kill& kill) {
  const auto began = throw_began(scene);
  if (!began) return false;
  const Stamp begin = *began;
  const auto in_state = [&] {
    for (const Told& t : scene.thrower().told())
      if (t.at >= begin && ((t.event == "state" && not_before(t.what, kill.state)) || t.event == "disarmed"))
        return true;
    return false;
  };
  wait_until(in_state, 60s);
  std::this_thread::sleep_for(kill.after);
  return true;
}

// What the survivors told of it, in their own words.
std::string words_since(TeamScene& scene, const Kill& kill, Stamp at) {
  std::string words;
  for (Member* m : {&scene.thrower(), &scene.skip()}) {
    if (m->name() == kill.whom && kill.signal == SIGKILL) continue;
    for (const char* event : {"aborted", "disarmed", "not ready", "silent", "stopped"}) {
      const auto told = m->told_since(at, event);
      if (!told) continue;
      words +=
          (words.empty() ? "" : "; ") + m->name() + ": " + told->event + (told->what.empty() ? "" : ", ") + told->what;
      break;
    }
  }
  return words;
}

void judge(TeamScene& scene, Result& r, Stamp at) {
  const bool world_ends = r.kill.whom == std::string("rink") && r.kill.signal == SIGKILL;
  if (world_ends) {
    r.still = true;  // there is no robot any more: what counts is that the next one does not move by itself
    return;
  }
  std::optional<Stamp> stood;
  wait_until([&] { return (stood = stood_since(scene.truth(), at)).has_value(); }, 20s);
  const auto& truth = scene.truth();
  if (stood) {
    const Stamp last = std::max(at, *stood);
    r.stop_s = r.moved ? seconds(last - at) : 0.0;
    r.way_m = moment_at(truth, last).y_m - moment_at(truth, at).y_m;
  }
  for (auto m = std::ranges::lower_bound(truth, at + notice_limit, {}, &TrueMoment::at); m != truth.end(); ++m)
    r.released_after = r.released_after || (m->released && !moment_at(truth, at + notice_limit).released);
  r.still = stood.has_value();
}

void strike(TeamScene& scene, const Kill& kill, Result& r, Stamp at) {
  member(scene, kill.whom).signal(kill.signal);
  std::this_thread::sleep_for(50ms);
  const TrueMoment before = moment_at(scene.truth(), at);
  r.moved = before.moves;
  r.speed_mps = before.speed_mps;
  r.released_before = moment_at(scene.truth(), at + notice_limit).released;
  if (kill.signal != SIGSTOP) return;
  std::this_thread::sleep_for(kill.stopped_for);
  member(scene, kill.whom).signal(SIGCONT);
}

void judge_throw(TeamScene& scene, const Kill& kill, Result& r) {
  const Stamp begin = now();
  r.began = throw_reaches(scene, kill);
  if (!r.began) return did_not(scene, r, "no throw began", begin);
  // A throw that a busy machine has ended before: then nobody has anything to say.
  const bool under_way = !scene.thrower().told_since(begin, "aborted");
  if (!under_way) did_not(scene, r, "the throw had ended before the signal", begin);
  const Stamp at = now();
  strike(scene, kill, r, at);
  judge(scene, r, at);
  wait_until([&] { return !(r.said = words_since(scene, kill, at)).empty(); }, 5s);

  // Whoever was killed comes back while the operator still holds the switch: nothing may move by itself.
  member(scene, kill.whom).start();
  const Stamp back = now();
  std::this_thread::sleep_for(still_for);
  for (const TrueMoment& m : scene.truth())
    if (m.at > back && m.moves) r.still = false;
  if (r.problem.empty() && !r.still) r.problem = "moves, or is not known to stand";
  if (r.problem.empty() && r.released_after) r.problem = "a stone was let go";
  if (r.problem.empty() && r.stop_s && *r.stop_s > seconds(stop_limit)) r.problem = "stopped late";
  if (r.problem.empty() && r.said.empty() && under_way) r.problem = "nobody said anything";
}

// One that was stopped while it thinks goes on, and decides after all.
void judge_thinking(TeamScene& scene, const Kill& kill, Result& r, Stamp at) {
  const bool killed = kill.signal == SIGKILL;
  const char* event = killed ? "game stopped" : "decided";
  if (!killed) scene.strategist().say("move");
  wait_until([&] { return scene.skip().told_since(at, event).has_value(); }, 30s);
  const auto told = scene.skip().told_since(at, event);
  r.still = true;
  for (const TrueMoment& m : scene.truth()) r.still = r.still && !(m.at > at && m.moves);
  if (!told) r.problem = "nobody said anything";
  if (!r.still) r.problem = "moves though nothing was ordered";
  if (told) r.said = "skip: " + told->event + ", " + told->what;
  // The turn is begun again with another strategist.
  if (killed && r.problem.empty() && !scene.begin_game()) did_not(scene, r, "the turn does not begin again", at);
}

// What the skip tells of it: empty, when it tells nothing in time.
std::string skip_tells(TeamScene& scene, Stamp since, const std::string& event, Duration limit) {
  wait_until([&] { return scene.skip().told_since(since, event).has_value(); }, limit);
  const auto told = scene.skip().told_since(since, event);
  return told ? "skip: " + told->event + ", " + told->what : std::string();
}

// What it has decided is thrown without it: the throw ends as any other, the game stops when the stone lies or was
// kept, and says why; and it is begun again with another.
void judge_decided(TeamScene& scene, const Kill& kill, Result& r, Stamp began, Stamp at) {
  wait_until([&] { return scene.thrower().told_since(began, "disarmed").has_value(); }, 60s);
  const auto end = scene.thrower().told_since(began, "disarmed");
  if (!end) return did_not(scene, r, "the throw does not end", began);
  r.still = true;
  r.said = "thrower: " + end->event + ", " + end->what;
  scene.hand().end();
  const bool thrown = scene.thrower().told_since(began, "released").has_value();
  if (!thrown) did_not(scene, r, "the throw was given up", began);
  const bool killed = kill.signal == SIGKILL;
  const std::string lost = killed ? skip_tells(scene, at, "strategist lost", 10s) : std::string();
  if (!lost.empty()) r.said += "; " + lost;
  if (killed && lost.empty()) r.problem = "nobody said anything";
  if (!killed || !thrown) scene.skip().say("stop");
  const std::string stopped = skip_tells(scene, at, "game stopped", 150s);
  r.said += "; " + stopped;
  if (stopped.empty()) did_not(scene, r, "the game does not stop", at);
  if (killed && thrown && stopped.find("vanished") == std::string::npos) r.problem = "it is not said why";
  if (r.problem.empty() && !scene.begin_game()) did_not(scene, r, "the game is not begun again", at);
}

// The shot is decided, the thrower armed, and the robot on its way; a machine that is too slow for that is given
// another try.
std::optional<Stamp> game_throws(TeamScene& scene, const Kill& kill) {
  const Stamp end = now() + attempts_limit;
  for (bool first = true; now() < end; first = false) {
    if (!first && !scene.set_up()) return std::nullopt;
    if (!scene.begin_game()) continue;
    const Stamp began = now();
    scene.strategist().say("move");
    scene.hand().start();
    if (!wait_until([&] { return scene.thrower().told_since(began, "throwing").has_value(); }, 40s)) continue;
    const Stamp strikes = scene.thrower().told_since(began, "throwing")->at + kill.after;
    wait_until([&] { return now() >= strikes || scene.thrower().told_since(began, "disarmed"); }, kill.after + 5s);
    if (!scene.thrower().told_since(began, "disarmed")) return began;
  }
  return std::nullopt;
}

// A strategist decides before anything moves: one that dies while it thinks has decided nothing.
void judge_game(TeamScene& scene, const Kill& kill, Result& r) {
  const Stamp begin = now();
  const bool thinks = kill.state == std::string("asked");
  std::optional<Stamp> began;
  if (thinks && scene.begin_game()) began = now();
  if (!thinks) began = game_throws(scene, kill);
  r.began = began.has_value();
  if (!r.began) return did_not(scene, r, thinks ? "no game began" : "no throw was under way", begin);
  if (thinks) std::this_thread::sleep_for(kill.after);
  const Stamp at = now();
  strike(scene, kill, r, at);
  thinks ? judge_thinking(scene, kill, r, at) : judge_decided(scene, kill, r, *began, at);
}

Result carry_out(TeamScene& scene, const Kill& kill) {
  Result r;
  r.kill = kill;
  const Stamp begin = now();
  if (!scene.set_up()) {
    did_not(scene, r, "can not be set up again", begin);
    return r;
  }
  is_strategist(kill) ? judge_game(scene, kill, r) : judge_throw(scene, kill, r);
  return r;
}

std::string row(int number, const Result& r) {
  const Kill& k = r.kill;
  const std::string how = k.signal == SIGKILL ? "killed" : fmt::format("stopped for {:.1f} s", seconds(k.stopped_for));
  std::string words = r.said;
  if (!r.not_shown.empty()) words = "not shown: " + r.not_shown + "; " + words;
  if (!r.problem.empty()) words = "**" + r.problem + "** " + words;
  return fmt::format("| {} | {} {} | {} + {:.2f} s | {:.2f} | {} | {} | {} | {} |", number, k.whom, how, k.state,
                     seconds(k.after), r.speed_mps, r.stop_s ? fmt::format("{:.2f}", *r.stop_s) : "-",
                     r.stop_s ? fmt::format("{:.2f}", r.way_m) : "-", r.released_before ? "yes" : "no", words);
}

// For whoever wants to know why.
void tell_all(TeamScene& scene, Stamp since) {
  for (Member* m : {&scene.rink(), &scene.thrower(), &scene.skip(), &scene.strategist(), &scene.hand()})
    for (const Told& t : m->told())
      if (t.at >= since) fmt::print(stderr, "  {:8.3f} {} {}: {}\n", seconds(t.at - since), m->name(), t.event, t.what);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 4 && count != 5) return 2;
  std::signal(SIGPIPE, SIG_IGN);
  const int trials = std::atoi(arguments[2]);
  const int first = count == 5 ? std::atoi(arguments[4]) : 0;
  std::mt19937 random(static_cast<std::uint32_t>(std::atol(arguments[3])));
  TeamScene scene(arguments[1], {.whole_skip = true, .strategists = 1});
  std::vector<double> stops;
  int problems = 0;
  int not_shown = 0;
  int moving = 0;
  fmt::print(
      "| | what | at | speed m/s | stood after s | way m | stone gone before | what the survivors say |\n"
      "|--:|---|---|--:|--:|--:|---|---|\n");
  for (int i = 0; i < trials; ++i) {
    const Stamp begin = now();
    const Result r = carry_out(scene, draw(random, first + i));
    fmt::print("{}\n", row(first + i + 1, r));
    if (!r.problem.empty() || !r.not_shown.empty()) tell_all(scene, begin);
    std::fflush(stdout);
    problems += r.problem.empty() ? 0 : 1;
    not_shown += r.not_shown.empty() ? 0 : 1;
    moving += r.moved ? 1 : 0;
    if (r.stop_s && r.moved) stops.push_back(*r.stop_s);
  }
  const bool again = scene.set_up();
  std::ranges::sort(stops);
  fmt::print(
      "\n{} signals, {} of them while the robot moved; {} problems; {} not shown, for the machine was late; set up "
      "once "
      "more after the last: {}.\n",
      trials, moving, problems, not_shown, again ? "yes" : "no");
  if (!stops.empty()) {
    fmt::print("Stood after {:.2f} s (median of {}), {:.2f} s (longest); limit {:.1f} s.\n", stops[stops.size() / 2],
               stops.size(), stops.back(), seconds(stop_limit));
  }
  return problems == 0 && (not_shown > 0 || (again && moving > 0)) ? 0 : 1;
}
