// Lines into a file by a thread of their own: a disk that is busy must not hold up a control loop (measured on
// 2026-11-22: a write of a hundred bytes waited for seconds while others kept the disk busy).
#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <thread>

namespace hogline {

class LineWriter {
 public:
  /// Writes to the descriptor, which must outlive it; it is not closed. -1: nowhere.
  explicit LineWriter(int file);
  /// Writes what is left.
  ~LineWriter();
  LineWriter(const LineWriter&) = delete;
  LineWriter& operator=(const LineWriter&) = delete;

  /// Never waits: while the thread takes what it writes next, the line stays here until the next call of either. Called
  /// by one thread.
  void post(const std::string& line);
  void pump();
  /// Some of what was posted could not be written, and never will be. Any thread.
  bool lost() const { return lost_; }
  /// Whether all that was posted is written; waits for it. Called when nothing more is posted.
  bool flush();

 private:
  void run(const std::stop_token& stop);
  void write_out();

  int file_;
  std::string held_;  ///< of the caller
  std::mutex mutex_;
  std::string waiting_;  ///< under the mutex
  std::atomic<bool> lost_ = false;
  std::jthread thread_;
};

}  // namespace hogline
