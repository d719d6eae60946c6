// A recorded bus, played back by a clock.
#pragma once

#include <vector>

#include "hw/clock.hpp"
#include "hw/socketcan/can_filter.hpp"
#include "hw/socketcan/candump_log.hpp"

namespace hogline::hw {

/// A CanBus whose traffic is a log. The first record is due when the clock shows `start`; every other one as much later
/// as it was recorded. A record whose time is before its predecessor's is due with its predecessor.
///
/// receive() gives what was received then: records marked as transmitted, and unmarked ones that match `ours`, are left
/// out, because the program under replay sends its own. What it sends goes nowhere and is kept in sent(), to be
/// compared with transmitted(). up() follows the recorded error frames: false from a bus-off to the restart; send() is
/// refused meanwhile. When the log has ended nothing more comes.
class ReplayBus final : public CanBus {
 public:
  /// The clock must outlive this object.
  ReplayBus(const std::vector<CandumpRecord>& log, const Clock& clock, Stamp start, std::vector<CanFilter> ours = {});

  CanSendResult send(const CanFrame& frame) override;
  std::optional<StampedCanFrame> receive() override;
  bool up() const override;

  bool ended() const { return next_ == incoming_.size(); }
  /// What was sent into the replay, with the clock's time.
  const std::vector<StampedCanFrame>& sent() const { return sent_; }
  /// What the log says was transmitted, at its due times.
  const std::vector<StampedCanFrame>& transmitted() const { return transmitted_; }

 private:
  struct StateChange {
    Stamp due;
    bool up;
  };

  const Clock& clock_;
  std::vector<StampedCanFrame> incoming_;
  std::vector<StateChange> states_;
  std::vector<StampedCanFrame> transmitted_;
  std::vector<StampedCanFrame> sent_;
  std::size_t next_ = 0;
};

}  // namespace hogline::hw
