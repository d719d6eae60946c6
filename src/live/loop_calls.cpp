#include "src/live/loop_calls.hpp"

#include <utility>

namespace hogline {

bool LoopCalls::run(std::function<void()> what) {
  std::packaged_task<void()> task(std::move(what));
  std::future<void> done = task.get_future();
  {
    const std::lock_guard lock(mutex_);
    if (closed_) return false;
    waiting_.push_back(std::move(task));
  }
  try {
    done.get();
  } catch (const std::future_error&) {
    return false;  // it was thrown away: the loop has ended
  }
  return true;
}

void LoopCalls::serve() {
  std::deque<std::packaged_task<void()>> now;
  {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    now.swap(waiting_);
  }
  for (auto& task : now) task();
}

void LoopCalls::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  waiting_.clear();
}

}  // namespace hogline
