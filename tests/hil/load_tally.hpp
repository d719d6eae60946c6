// Counts the control cycles on a bus, and how old the feedback is when the command goes out: frame by frame, so that a
// run may take as long as it likes.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>

#include "hw/socketcan/can_tap.hpp"

namespace hogline::hil {

/// A cycle goes from one SYNC of ours to the next, in the kernel's own times.
class LoadTally final : public hw::CanTap {
 public:
  void record(const hw::CandumpRecord& record) override;

  long cycles() const { return cycles_; }
  /// Of those in which not each of the six RPDOs was on the bus exactly once.
  long cycles_without_all_commands() const { return without_command_; }
  /// TPDOs that a cycle each should have brought, and did not.
  long missing_feedback() const;
  /// From the left wheel's TPDO1 to its RPDO1, both as stamped by the kernel; `share` 0.5 is the median. In ms, to 0.1.
  double latency_ms(double share) const;
  double longest_latency_ms() const { return longest_ms_; }
  /// Lines of whole milliseconds.
  std::string histogram() const;

 private:
  void end_cycle();

  static constexpr int bins = 1000;  // of 0.1 ms; the last one holds all that is longer
  long cycles_ = 0;
  long without_command_ = 0;
  std::map<std::uint32_t, long> total_;
  std::map<std::uint32_t, long> since_sync_;
  std::optional<std::chrono::microseconds> feedback_;
  std::array<long, bins> latencies_{};
  long latency_count_ = 0;
  double longest_ms_ = 0.0;
};

}  // namespace hogline::hil
