// Whether the machine kept programs waiting: what nobody may be blamed for who is measured against the wall clock.
#pragma once

#include <sys/types.h>

#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "vision/percepts/stamp.hpp"

namespace hogline::live_test {

/// How long a thread that could run did not, within one look of the watch.
struct Wait {
  Stamp at{};
  std::string who;       ///< the program, or "machine": a processor stood
  bool control = false;  ///< its first thread: the control loop, or the rink's world
  Duration waited{};
};

/// Asks the kernel (/proc/PID/task/TID/schedstat: time spent waiting for a processor), and has a thread of its own on
/// each processor, that runs before all others where it may: when one of them sleeps too long, that processor stood.
class MachineWatch {
 public:
  MachineWatch();
  ~MachineWatch();
  MachineWatch(const MachineWatch&) = delete;
  MachineWatch& operator=(const MachineWatch&) = delete;

  /// From now on `who` has this process.
  void follow(const std::string& who, pid_t process);
  /// The longest that a processor stood, or that a thread waited within one look, between the two; when `control`,
  /// of the programs' first threads alone.
  Duration longest(bool control, Stamp from, Stamp until) const;

 private:
  void look(Stamp now);
  void look_at(const std::string& who, pid_t process, Stamp now);
  void run(const std::stop_token& stop);
  void run_on(std::size_t processor, const std::stop_token& stop);

  mutable std::mutex mutex_;  ///< over all that follows
  std::map<std::string, pid_t> processes_;
  std::map<pid_t, unsigned long long> waited_ns_;  ///< of each thread, when it was looked at last
  std::vector<Wait> waits_;
  std::jthread thread_;  // last, as are these: they use all of the above
  std::vector<std::jthread> processors_;
};

}  // namespace hogline::live_test
