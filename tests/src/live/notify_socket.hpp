// What systemd would hear of a service (sd_notify(3)), and when.
#pragma once

#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "vision/percepts/stamp.hpp"

namespace hogline::live_test {

/// One word of a service: "READY=1", "WATCHDOG=1".
struct Notification {
  Stamp at{};  ///< when it was read here
  std::string word;
};

/// A datagram socket that is read at once by a thread of its own.
class NotifySocket {
 public:
  /// Throws std::system_error.
  explicit NotifySocket(const std::string& path);
  ~NotifySocket();
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  std::vector<Notification> heard() const;
  /// How often since then.
  long count(const std::string& word, Stamp since = Stamp{}) const;
  /// What a service manager with a watchdog of this length tells a service.
  std::vector<std::string> environment(Duration watchdog) const;

 private:
  void listen(const std::stop_token& stop);

  std::string path_;
  int socket_ = -1;
  mutable std::mutex mutex_;
  std::vector<Notification> heard_;  ///< under the mutex
  std::jthread thread_;
};

}  // namespace hogline::live_test
