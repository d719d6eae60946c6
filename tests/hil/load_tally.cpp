#include "tests/hil/load_tally.hpp"

#include <algorithm>
#include <cstdio>

namespace hogline::hil {
namespace {

constexpr std::array<std::uint32_t, 6> rpdos{0x201, 0x202, 0x203, 0x303, 0x204, 0x304};
constexpr std::array<std::uint32_t, 8> tpdos{0x181, 0x281, 0x182, 0x282, 0x183, 0x283, 0x184, 0x284};
constexpr std::uint32_t sync = 0x080;
constexpr std::uint32_t feedback_of_the_left = 0x181;
constexpr std::uint32_t command_to_the_left = 0x201;

}  // namespace

void LoadTally::record(const hw::CandumpRecord& record) {
  if (record.error_frame) return;
  const std::uint32_t id = record.frame.id;
  ++total_[id];
  if (record.direction == hw::CanDirection::received) {
    if (id == feedback_of_the_left) feedback_ = record.unix_time;
    return;
  }
  ++since_sync_[id];
  if (id == command_to_the_left && feedback_) {
    const double ms = static_cast<double>((record.unix_time - *feedback_).count()) * 1e-3;
    ++latencies_[static_cast<std::size_t>(std::clamp(static_cast<int>(ms * 10.0), 0, bins - 1))];
    ++latency_count_;
    longest_ms_ = std::max(longest_ms_, ms);
  }
  if (id == sync) end_cycle();
}

void LoadTally::end_cycle() {
  const bool complete = std::ranges::all_of(rpdos, [&](std::uint32_t rpdo) { return since_sync_[rpdo] == 1; });
  if (cycles_++ > 0 && !complete) ++without_command_;
  since_sync_.clear();
}

long LoadTally::missing_feedback() const {
  long missing = 0;
  for (const std::uint32_t id : tpdos) {
    const auto seen = total_.find(id);
    missing += std::max(0L, cycles_ - (seen == total_.end() ? 0 : seen->second));
  }
  return missing;
}

double LoadTally::latency_ms(double share) const {
  long below = 0;
  for (std::size_t bin = 0; bin < latencies_.size(); ++bin) {
    below += latencies_[bin];
    if (static_cast<double>(below) >= share * static_cast<double>(latency_count_))
      return 0.1 * static_cast<double>(bin);
  }
  return 0.0;
}

std::string LoadTally::histogram() const {
  std::map<int, long> by_ms;
  for (std::size_t bin = 0; bin < latencies_.size(); ++bin) {
    if (latencies_[bin] > 0) by_ms[std::min(static_cast<int>(bin) / 10, 20)] += latencies_[bin];
  }
  std::string text;
  for (const auto& [ms, count] : by_ms) {
    std::array<char, 40> line{};
    std::snprintf(line.data(), line.size(), "  %s%2d ms %7ld\n", ms == 20 ? ">" : " ", ms, count);
    text += line.data();
  }
  return text;
}

}  // namespace hogline::hil
