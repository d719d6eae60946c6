#include "src/campaign/throwing_crew.hpp"

#include <algorithm>
#include <cassert>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace hogline::campaign {
namespace {

// Hands out numbers, and takes rows back in any order.
class Desk {
 public:
  Desk(int throws, Folder& folder, const Tick& tick)
      : throws_(throws), next_(static_cast<int>(folder.rows().size())), folder_(folder), tick_(tick) {}

  std::optional<int> next() {
    const std::lock_guard lock(mutex_);
    if (failure_ || next_ >= throws_) return std::nullopt;
    return next_++;
  }

  void hand_in(const Row& row) {
    const std::lock_guard lock(mutex_);
    waiting_.emplace(row.number, row);
    while (!waiting_.empty() && waiting_.begin()->first == static_cast<int>(folder_.rows().size())) {
      folder_.append(waiting_.begin()->second);
      waiting_.erase(waiting_.begin());
      if (tick_) tick_(folder_.rows().back());
    }
  }

  void fail(std::exception_ptr failure) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::move(failure);
  }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::mutex mutex_;
  int throws_;
  int next_;
  Folder& folder_;
  const Tick& tick_;
  std::map<int, Row> waiting_;
  std::exception_ptr failure_;
};

void work(const Plan& plan, Desk& desk) {
  try {
    while (const auto number = desk.next()) {
      const Draw draw = plan.draw(*number);
      desk.hand_in(row_of(draw, throw_stone(plan.request(draw), {}).result));
    }
  } catch (...) {
    desk.fail(std::current_exception());
  }
}

}  // namespace

void throw_missing(const Plan& plan, int throws, int jobs, Folder& folder, const Tick& tick) {
  assert(jobs >= 1);
  Desk desk(throws, folder, tick);
  {
    std::vector<std::jthread> crew;
    for (int i = 1; i < jobs; ++i) crew.emplace_back([&] { work(plan, desk); });
    work(plan, desk);
  }
  desk.rethrow();
}

}  // namespace hogline::campaign
