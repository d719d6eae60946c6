// Listens on the CAN bus without sending: who is there, how often, and whether somebody else is master.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <set>

#include "hw/canopen/nmt.hpp"

namespace hogline::doctor {

struct HeardNode {
  int heartbeats = 0;
  Stamp first{};
  Stamp last{};
  hw::NmtState state = hw::NmtState::unknown;
  /// Between two heartbeats; nothing before the second.
  std::optional<double> period_s() const;
};

class BusEar {
 public:
  explicit BusEar(std::set<std::uint8_t> own_nodes, std::uint8_t master_node);

  void on_frame(const hw::StampedCanFrame& received);
  const HeardNode& node(std::uint8_t id) const { return nodes_[id]; }
  std::uint64_t frames() const { return frames_; }
  /// Frames that only a master sends: NMT, SYNC, our heartbeat, RPDOs for our nodes. We send none of them.
  std::uint64_t other_master() const { return other_master_; }

 private:
  bool is_masters(const hw::CanFrame& frame) const;

  std::set<std::uint8_t> own_nodes_;
  std::uint8_t master_node_;
  std::array<HeardNode, 128> nodes_{};
  std::uint64_t frames_ = 0;
  std::uint64_t other_master_ = 0;
};

}  // namespace hogline::doctor
