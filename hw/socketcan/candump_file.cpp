#include "hw/socketcan/candump_file.hpp"

#include <cerrno>
#include <system_error>

namespace hogline::hw {

CandumpFile::CandumpFile(const std::string& path, std::size_t queue_length) : queue_length_(queue_length) {
  file_.open(path, std::ios::trunc);
  if (!file_) throw std::system_error(errno, std::generic_category(), path);
  queue_.reserve(queue_length_);
  writer_ = std::thread([this] { write_until_stopped(); });
}

CandumpFile::~CandumpFile() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  writer_.join();
}

void CandumpFile::record(const CandumpRecord& record) {
  const std::lock_guard lock(mutex_);
  if (queue_.size() < queue_length_)
    queue_.push_back(record);
  else
    ++lost_;
}

std::uint64_t CandumpFile::lost() const {
  const std::lock_guard lock(mutex_);
  return lost_;
}

// The recorder does not wake the writer: a wake-up for each frame would cost the control thread a system call.
void CandumpFile::write_until_stopped() {
  std::vector<CandumpRecord> batch;
  batch.reserve(queue_length_);
  for (bool stopping = false; !stopping;) {
    {
      std::unique_lock lock(mutex_);
      wake_.wait_for(lock, std::chrono::milliseconds(100), [this] { return stop_; });
      stopping = stop_;
      batch.swap(queue_);
    }
    write(batch);
    batch.clear();
  }
}

void CandumpFile::write(const std::vector<CandumpRecord>& batch) {
  if (batch.empty()) return;
  for (const CandumpRecord& record : batch) file_ << encode_candump_line(record) << '\n';
  file_.flush();
  if (file_) return;
  file_.clear();
  const std::lock_guard lock(mutex_);
  lost_ += batch.size();
}

}  // namespace hogline::hw
