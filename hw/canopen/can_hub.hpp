// Several adapters on one bus: wheels, head, and whoever else listens.
#pragma once

#include <cstdint>
#include <deque>
#include <list>

#include "hw/can_bus.hpp"

namespace hogline::hw {

/// Each endpoint receives every frame of the bus, in order; none receives what another endpoint sends, as one node on
/// a bus does not. Used by one thread.
class CanHub {
 public:
  /// Frames that one endpoint can leave unread; beyond it the newest are lost and counted.
  static constexpr std::size_t most_unread = 1024;

  /// The bus must outlive the hub.
  explicit CanHub(CanBus& bus) : bus_(bus) {}
  CanHub(const CanHub&) = delete;
  CanHub& operator=(const CanHub&) = delete;

  /// Lives as long as the hub.
  CanBus& make_endpoint() { return endpoints_.emplace_back(*this); }
  std::uint64_t lost() const { return lost_; }

 private:
  class Endpoint final : public CanBus {
   public:
    explicit Endpoint(CanHub& hub) : hub_(hub) {}
    CanSendResult send(const CanFrame& frame) override { return hub_.bus_.send(frame); }
    std::optional<StampedCanFrame> receive() override;
    bool up() const override { return hub_.bus_.up(); }
    bool error_passive() const override { return hub_.bus_.error_passive(); }

    std::deque<StampedCanFrame> unread;

   private:
    CanHub& hub_;
  };

  void distribute();

  CanBus& bus_;
  std::list<Endpoint> endpoints_;
  std::uint64_t lost_ = 0;
};

}  // namespace hogline::hw
