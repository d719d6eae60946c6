#include "tests/src/live/machine_watch.hpp"

#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <system_error>

namespace hogline::live_test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr Duration tick = 5ms;
constexpr Duration look_period = 50ms;
constexpr Duration least = 5ms;  // shorter waits are everybody's
constexpr int before_all_others = 50;

Stamp present() { return std::chrono::steady_clock::now(); }

std::optional<unsigned long long> waited_ns(const fs::path& task) {
  std::ifstream file(task / "schedstat");
  unsigned long long ran = 0, waited = 0;
  if (!(file >> ran >> waited)) return std::nullopt;
  return waited;
}

}  // namespace

MachineWatch::MachineWatch() : thread_([this](const std::stop_token& stop) { run(stop); }) {}
MachineWatch::~MachineWatch() = default;

void MachineWatch::follow(const std::string& who, pid_t process) {
  const std::lock_guard lock(mutex_);
  processes_[who] = process;
}

Duration MachineWatch::longest(const std::string& who, bool control, Stamp from, Stamp until) const {
  const std::lock_guard lock(mutex_);
  Duration longest{};
  for (const Wait& wait : waits_) {
    if (wait.at < from || wait.at > until || wait.who != who || (control && !wait.control)) continue;
    longest = std::max(longest, wait.waited);
  }
  return longest;
}

void MachineWatch::look_at(const std::string& who, pid_t process, Stamp now) {
  std::error_code problem;
  for (const auto& task : fs::directory_iterator("/proc/" + std::to_string(process) + "/task", problem)) {
    const auto waited = waited_ns(task.path());
    if (!waited) continue;
    const pid_t id = std::stoi(task.path().filename());
    const auto known = waited_ns_.find(id);
    const Duration more = known == waited_ns_.end() ? Duration{} : Duration(*waited - known->second);
    waited_ns_[id] = *waited;
    if (more >= least) waits_.push_back({now, who, id == process, more});
  }
}

void MachineWatch::look(Stamp now) {
  const std::lock_guard lock(mutex_);
  for (const auto& [who, process] : processes_) look_at(who, process, now);
}

// Without the right to run first its own waiting says no more than what the kernel tells of the others.
void MachineWatch::run(const std::stop_token& stop) {
  const sched_param first{.sched_priority = before_all_others};
  const bool runs_first = pthread_setschedparam(pthread_self(), SCHED_FIFO, &first) == 0;
  Stamp looked = present();
  while (!stop.stop_requested()) {
    const Stamp before = present();
    std::this_thread::sleep_for(tick);
    const Stamp now = present();
    const Duration stood = now - before - tick;
    if (runs_first && stood >= least) {
      const std::lock_guard lock(mutex_);
      waits_.push_back({now, "machine", true, stood});
    }
    if (now - looked < look_period) continue;
    looked = now;
    look(now);
  }
}

}  // namespace hogline::live_test
