#include "src/live_game.hpp"

#include <fmt/format.h>

#include <array>
#include <exception>
#include <filesystem>
#include <utility>

#include "hw/clock.hpp"
#include "src/live/process.hpp"

namespace hogline {
namespace {

using game::RefereePhase;
namespace fs = std::filesystem;

constexpr auto pause = std::chrono::milliseconds(5);
constexpr const char* as_said = "as its operator said";

// A game that is gone on with, and one that is begun after another, leave what was written before as it is.
std::string folder_without_a_game(const fs::path& folder) {
  if (!fs::exists(folder / "game.jsonl")) return folder;
  int number = 2;
  while (fs::exists(folder / std::to_string(number) / "game.jsonl")) ++number;
  return folder / std::to_string(number);
}

std::string words_of(const servo::GameState& state) {
  return fmt::format("{} : {} after end {}, shot {} of 16", servo::total(state, Team::first),
                     servo::total(state, Team::second), state.end, state.shot + 1);
}

}  // namespace

/// Tells in short what the journal writes at length.
class LiveGame::Listener final : public game::GameListener {
 public:
  Listener(LiveGame& game, game::GameListener& journal) : game_(game), journal_(journal) {}
  void begun(const std::array<std::string, servo::team_count>& names) override {
    game_.tell("game", names[0] + " against " + names[1]);
    journal_.begun(names);
  }
  void stands(const servo::GameUpdate& update) override {
    game_.tell("asked", words_of(update.state));
    journal_.stands(update);
  }
  void decided(const game::Turn& turn) override {
    game_.tell("decided", turn.decision.plan.empty() ? "by its program" : turn.decision.plan);
    journal_.decided(turn);
  }
  void thrown(const game::Turn& turn, const game::ThrowReport& report, const servo::Judged& judged) override {
    game_.tell(report.end == game::ThrowEnd::thrown ? "thrown" : "given away", report.reason);
    journal_.thrown(turn, report, judged);
  }
  void stopped(const std::string& reason) override { journal_.stopped(reason); }

 private:
  LiveGame& game_;
  game::GameListener& journal_;
};

/// Tells once of each whose time to decide will not come again: it is heard at once, and ends the game later.
class LiveGame::LostStrategists {
 public:
  LostStrategists(LiveGame& game, const std::array<hw::Strategist*, servo::team_count>& strategists)
      : game_(game), strategists_(strategists) {}
  void watch() {
    for (const std::size_t side : {0u, 1u}) {
      const hw::StrategistState& state = strategists_[side]->state();
      if (told_[side] || state.phase != hw::StrategistPhase::failed) continue;
      told_[side] = true;
      game_.tell("strategist lost", state.reason + "; what was decided is played to its end");
    }
  }

 private:
  LiveGame& game_;
  std::array<hw::Strategist*, servo::team_count> strategists_;
  std::array<bool, servo::team_count> told_{};
};

/// What is to be gone on with is kept however this sitting ends.
struct LiveGame::Kept {
  Kept(LiveGame& of, const game::Referee& judge, const LiveThrows& thrown) : game(of), referee(judge), throws(thrown) {}
  ~Kept() {
    game.state_ = referee.state();
    game.ice_ = throws.ice();
  }
  Kept(const Kept&) = delete;
  Kept& operator=(const Kept&) = delete;
  LiveGame& game;
  const game::Referee& referee;
  const LiveThrows& throws;
};

LiveGame::LiveGame(const TableOptions& table, double sheet_width_m, const servo::ThrowerSkill& skill, LiveSkip& robot,
                   LoopCalls& calls)
    : table_(table), sheet_width_m_(sheet_width_m), skill_(skill), robot_(robot), calls_(calls), ice_({}) {}

LiveGame::~LiveGame() = default;

std::string LiveGame::play() {
  if (playing_) return "a game is played: stop ends it";
  playing_ = true;
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  return {};
}

void LiveGame::run(const std::stop_token& stop) {
  run_as_others();
  try {
    referee(stop);
  } catch (const std::exception& error) {
    tell("game stopped", error.what());
  }
  playing_ = false;
}

// Lock-step with the strategists: a stone that runs is followed to its end before anything else ends.
void LiveGame::referee(const std::stop_token& stop) {
  TableOptions here = table_;
  here.out = folder_without_a_game(table_.out);
  LiveThrows throws(robot_, calls_, skill_, ice_,
                    [this](const char* event, const std::string& what) { tell(event, what); });
  GameTable table(here, sheet_width_m_, skill_, [&throws] { return throws.ice(); });
  tell("table", "waits for whoever decides; the record is in " + here.out);
  Listener listener(*this, table.journal());
  game::Referee referee(table.setting(), state_.value_or(servo::new_game(table.setting())), table.strategists(), throws,
                        listener);
  {
    const Kept kept(*this, referee, throws);
    const std::string reason = sit(referee, table, throws, stop);
    const bool ended = referee.phase() == RefereePhase::over || referee.phase() == RefereePhase::stopped;
    if (!ended) table.journal().stopped(reason);
    table.close();
    if (referee.phase() != RefereePhase::over) return tell("game stopped", reason);
    tell("game over", words_of(referee.state()) + (referee.reason().empty() ? "" : "; " + referee.reason()));
  }
  state_.reset();
}

// Until it is over, or stops: why it did.
std::string LiveGame::sit(game::Referee& referee, GameTable& table, LiveThrows& throws, const std::stop_token& stop) {
  LostStrategists lost(*this, table.strategists());
  const hw::SteadyClock clock;
  while (referee.phase() != RefereePhase::over && referee.phase() != RefereePhase::stopped) {
    if (stop.stop_requested() && referee.phase() != RefereePhase::throwing) return as_said;
    if (stop.stop_requested()) throws.cancel(as_said);
    referee.step(clock.now());
    if (referee.phase() == RefereePhase::throwing) lost.watch();
    std::this_thread::sleep_for(pause);
  }
  return stop.stop_requested() && referee.reason().ends_with(as_said) ? as_said : referee.reason();
}

void LiveGame::tell(const std::string& event, const std::string& what) {
  const std::lock_guard lock(mutex_);
  told_.push_back({event, what});
}

void LiveGame::news(const LiveThrows::Tell& tell) {
  std::deque<Word> words;
  {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    words.swap(told_);
  }
  for (const Word& word : words) tell(word.event.c_str(), word.what);
}

}  // namespace hogline
