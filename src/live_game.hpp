// A game that the robots play on their own ice: strategists and rules in a thread of their own beside the skip's
// control loop. A game that was stopped is gone on with where it stood; each sitting has a record of its own, in the
// first of OUT, OUT/2, OUT/3, ... that has none.
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "src/game_table.hpp"
#include "src/live/live_throws.hpp"

namespace hogline {

class LiveGame {
 public:
  /// Skip and calls must outlive it; used by the loop's thread.
  LiveGame(const TableOptions& table, double sheet_width_m, const servo::ThrowerSkill& skill, LiveSkip& robot,
           LoopCalls& calls);
  /// Precondition: the calls are closed.
  ~LiveGame();
  LiveGame(const LiveGame&) = delete;
  LiveGame& operator=(const LiveGame&) = delete;

  /// Begins it, or goes on with it. Why not; empty: it is played.
  std::string play();
  /// As soon as nothing moves that was ordered: neither whoever thinks nor whoever is to arm the thrower is waited for.
  void stop() { thread_.request_stop(); }
  bool playing() const { return playing_; }
  /// What has happened since the last call, in a word and in words. Never waits.
  void news(const LiveThrows::Tell& tell);

 private:
  class Listener;
  class LostStrategists;
  struct Kept;
  struct Word {
    std::string event;
    std::string what;
  };

  void run(const std::stop_token& stop);
  void referee(const std::stop_token& stop);
  std::string sit(game::Referee& referee, GameTable& table, LiveThrows& throws, const std::stop_token& stop);
  void tell(const std::string& event, const std::string& what);

  TableOptions table_;
  double sheet_width_m_;
  servo::ThrowerSkill skill_;
  LiveSkip& robot_;
  LoopCalls& calls_;
  std::optional<servo::GameState> state_;  ///< of the thread, as is the ice
  servo::IceModel ice_;
  std::mutex mutex_;
  std::deque<Word> told_;  ///< under the mutex
  std::atomic<bool> playing_ = false;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace hogline
