// Questions and orders to what a control loop steps, from another thread: they are done in the loop's own thread, which
// never waits for whoever asks.
#pragma once

#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <optional>

namespace hogline {

class LoopCalls {
 public:
  /// From another thread: waits until the loop has done it. Empty: the loop has ended, and it was not done.
  template <typename Do>
  auto ask(Do what) -> std::optional<decltype(what())> {
    std::optional<decltype(what())> answer;
    if (!run([&] { answer = what(); })) return std::nullopt;
    return answer;
  }

  /// Of the loop, once each control period: does what was asked. Never waits.
  void serve();
  /// Of the loop: it ends.
  void close();

 private:
  bool run(std::function<void()> what);

  std::mutex mutex_;
  std::deque<std::packaged_task<void()>> waiting_;  ///< under the mutex, as is what follows
  bool closed_ = false;
};

}  // namespace hogline
