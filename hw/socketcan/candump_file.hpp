// A candump log file that is written beside the control loop.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <fstream>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "hw/socketcan/can_tap.hpp"

namespace hogline::hw {

/// record() only fills a bounded queue; a thread of its own writes to the disk. A disk that is slow or full costs
/// lines, never time: lost() counts them. Lines reach the file within a tenth of a second, and all of them when the
/// object goes.
class CandumpFile final : public CanTap {
 public:
  /// Throws std::system_error if the file can not be created.
  explicit CandumpFile(const std::string& path, std::size_t queue_length = 8192);
  ~CandumpFile() override;
  CandumpFile(const CandumpFile&) = delete;
  CandumpFile& operator=(const CandumpFile&) = delete;

  void record(const CandumpRecord& record) override;
  /// Records that did not fit the queue or could not be written.
  std::uint64_t lost() const;

 private:
  void write_until_stopped();
  void write(const std::vector<CandumpRecord>& batch);

  std::ofstream file_;
  const std::size_t queue_length_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<CandumpRecord> queue_;
  std::uint64_t lost_ = 0;
  bool stop_ = false;
  std::thread writer_;  // last: it uses everything above
};

}  // namespace hogline::hw
