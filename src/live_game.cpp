#include "src/live_game.hpp"

#include <fmt/format.h>

#include <exception>
#include <utility>

#include "hw/clock.hpp"
#include "src/live/process.hpp"
#include "src/output/output_folder.hpp"

namespace hogline {
namespace {

using game::RefereePhase;

constexpr auto pause = std::chrono::milliseconds(5);

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
  LiveThrows throws(robot_, calls_, skill_, ice_,
                    [this](const char* event, const std::string& what) { tell(event, what); });
  const OutputFolder folder("--out", table_.out);
  GameTable table(table_, sheet_width_m_, skill_, [&throws] { return throws.ice(); });
  tell("table", "waits for whoever decides");
  Listener listener(*this, table.journal());
  game::Referee referee(table.setting(), state_.value_or(servo::new_game(table.setting())), table.strategists(), throws,
                        listener);
  const hw::SteadyClock clock;
  while (referee.phase() != RefereePhase::over && referee.phase() != RefereePhase::stopped) {
    if (stop.stop_requested() && referee.phase() != RefereePhase::throwing) break;
    referee.step(clock.now());
    std::this_thread::sleep_for(pause);
  }
  state_ = referee.state();
  ice_ = throws.ice();
  table.close();
  if (referee.phase() == RefereePhase::over) {
    tell("game over", words_of(*state_) + (referee.reason().empty() ? "" : "; " + referee.reason()));
    state_.reset();
  } else {
    tell("game stopped", referee.phase() == RefereePhase::stopped ? referee.reason() : "as its operator said");
  }
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
