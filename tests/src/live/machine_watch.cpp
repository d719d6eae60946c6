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

MachineWatch::MachineWatch() : thread_([this](const std::stop_token& stop) { run(stop); }) {
  for (std::size_t i = 0; i < std::thread::hardware_concurrency(); ++i)
    processors_.emplace_back([this, i](const std::stop_token& stop) { run_on(i, stop); });
}
MachineWatch::~MachineWatch() = default;

void MachineWatch::follow(const std::string& who, pid_t process) {
  const std::lock_guard lock(mutex_);
  processes_[who] = process;
}

Duration MachineWatch::longest(bool control, Stamp from, Stamp until) const {
  const std::lock_guard lock(mutex_);
  Duration longest{};
  for (const Wait& wait : waits_) {
    if (wait.at < from || wait.at > until || (control && !wait.control)) continue;
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

// A processor that its host takes away for a while stands for whoever was on it, and for nobody else.
void MachineWatch::run_on(std::size_t processor, const std::stop_token& stop) {
  cpu_set_t only;
  CPU_ZERO(&only);
  CPU_SET(processor, &only);
  const sched_param first{.sched_priority = before_all_others};
  if (pthread_setaffinity_np(pthread_self(), sizeof only, &only) != 0) return;
  // Whoever has not the right to run first has no program that may: it waits as those do.
  pthread_setschedparam(pthread_self(), SCHED_FIFO, &first);
  while (!stop.stop_requested()) {
    const Stamp before = present();
    std::this_thread::sleep_for(tick);
    const Stamp now = present();
    const Duration stood = now - before - tick;
    if (stood < least) continue;
    const std::lock_guard lock(mutex_);
    waits_.push_back({now, "machine", true, stood});
  }
}

void MachineWatch::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::this_thread::sleep_for(look_period);
    look(present());
  }
}

}  // namespace hogline::live_test
