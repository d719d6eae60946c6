// What every long-running program does besides its work: lines about what happens, an orderly end, the right to run
// first, and signs of life for systemd.
#pragma once

#include <string>
#include <string_view>

#include "vision/percepts/stamp.hpp"

namespace hogline {

/// One line of JSON on stdout: {"t_s": steady clock, "who", "event", "what"}; it waits for nothing. Called by one
/// thread; the last lines leave with the next call of either, or when the program ends.
void pump_told();
void tell(std::string_view who, std::string_view event, std::string_view what);

/// SIGTERM and SIGINT ask the program to end. SIGPIPE is ignored. To be called before any thread is made.
void listen_for_the_end();
bool asked_to_end();

/// Who runs before whom in a robot's program, highest first: control waits for the answers of the Modbus devices'
/// threads, and must never wait for a look. A look that other programs hold up would come too late, and hold locks
/// meanwhile.
inline constexpr int device_priority = 15;
inline constexpr int control_priority = 10;
inline constexpr int look_priority = 5;

/// Asks to run before other programs (SCHED_FIFO). Refused without the right to (ulimit -r, CAP_SYS_NICE): then it runs
/// as others do.
bool run_first(int priority);
/// The opposite, for threads that are made by one that runs first.
void run_as_others();

/// systemd's notifications (sd_notify(3)): a word as a datagram to NOTIFY_SOCKET. Without systemd it says nothing.
class ServiceManager {
 public:
  ServiceManager();
  ~ServiceManager();
  ServiceManager(const ServiceManager&) = delete;
  ServiceManager& operator=(const ServiceManager&) = delete;

  void ready(const std::string& status);
  /// Every control period: tells three times within the watchdog's time that the loop runs.
  void alive(Stamp now);
  void stopping();

 private:
  void say(const std::string& words) const;

  std::string path_;
  int socket_ = -1;
  Duration period_{};  ///< zero: no watchdog
  Stamp next_{};
};

}  // namespace hogline
