#include "src/live/process.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "src/live/line_writer.hpp"

namespace hogline {
namespace {

volatile std::sig_atomic_t end_asked = 0;

void note_end(int) { end_asked = 1; }

LineWriter& told() {
  static LineWriter lines(STDOUT_FILENO);
  return lines;
}

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string() : std::string(value);
}

}  // namespace

void tell(std::string_view who, std::string_view event, std::string_view what) {
  const double t_s = seconds(std::chrono::steady_clock::now().time_since_epoch());
  const nlohmann::ordered_json line{{"t_s", t_s}, {"who", who}, {"event", event}, {"what", what}};
  told().post(line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

void pump_told() { told().pump(); }

void listen_for_the_end() {
  struct sigaction action {};
  action.sa_handler = note_end;
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGINT, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

bool asked_to_end() { return end_asked != 0; }

bool run_first(int priority) {
  const sched_param parameters{.sched_priority = priority};
  return ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameters) == 0;
}

void run_as_others() {
  const sched_param ordinary{.sched_priority = 0};
  ::pthread_setschedparam(::pthread_self(), SCHED_OTHER, &ordinary);
}

ServiceManager::ServiceManager() : path_(variable("NOTIFY_SOCKET")) {
  if (path_.empty()) return;
  socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const long watchdog_us = std::atol(variable("WATCHDOG_USEC").c_str());
  const std::string meant_for = variable("WATCHDOG_PID");
  if (meant_for.empty() || meant_for == std::to_string(getpid())) period_ = std::chrono::microseconds(watchdog_us / 3);
}

ServiceManager::~ServiceManager() {
  if (socket_ >= 0) close(socket_);
}

void ServiceManager::ready(const std::string& status) { say("READY=1\nSTATUS=" + status); }

void ServiceManager::alive(Stamp now) {
  pump_told();
  if (period_ <= Duration::zero() || now < next_) return;
  next_ = now + period_;
  say("WATCHDOG=1");
}

void ServiceManager::stopping() { say("STOPPING=1"); }

void ServiceManager::say(const std::string& words) const {
  sockaddr_un address{};
  if (socket_ < 0 || path_.size() >= sizeof(address.sun_path)) return;
  address.sun_family = AF_UNIX;
  std::ranges::copy(path_, address.sun_path);
  if (path_.front() == '@') address.sun_path[0] = '\0';  // a name in Linux's abstract space
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + path_.size());
  if (sendto(socket_, words.data(), words.size(), MSG_NOSIGNAL, reinterpret_cast<const sockaddr*>(&address), length) <
      0) {
    return;  // whoever manages services and does not listen gets no second try
  }
}

}  // namespace hogline
