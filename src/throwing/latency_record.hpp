// How long things took: quantiles of many.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "vision/percepts/stamp.hpp"

namespace hogline {

class LatencyRecord {
 public:
  void add(Duration latency) { latencies_.push_back(latency); }
  std::size_t size() const { return latencies_.size(); }
  /// Nearest rank. Zero while there are none. Precondition: 0 <= share <= 1.
  double quantile_ms(double share) const {
    if (latencies_.empty()) return 0.0;
    std::vector<Duration> sorted = latencies_;
    std::ranges::sort(sorted);
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
    return 1e3 * seconds(sorted[std::max<std::size_t>(rank, 1) - 1]);
  }

 private:
  std::vector<Duration> latencies_;
};

/// Frame, command and loop of a throw against the wall clock.
struct RealtimeFigures {
  std::size_t commands = 0;            ///< first commands that knew a new frame
  double frame_to_command_p50_ms = 0;  ///< from the middle of the exposure to the CAN frame with the set-point
  double frame_to_command_p99_ms = 0;
  double look_to_command_p50_ms = 0;  ///< of that: from the look being done to the CAN frame
  double look_to_command_p99_ms = 0;
  std::size_t periods = 0;
  double late_p99_ms = 0;  ///< by which the control period began after its time
  double late_max_ms = 0;
  int looks = 0;
  bool scheduled_first = false;  ///< the system let control and rink run before other programs
};

}  // namespace hogline
