// A CAN bus inside the process, on a stepped clock: what one endpoint sends, every other one receives.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <optional>
#include <random>

#include "hw/can_bus.hpp"
#include "hw/clock.hpp"

namespace hogline::hw::sim {

struct VirtualCanBusConfig {
  /// Bits a second; 0: frames take no time. 11-bit frames of n bytes take 47 + 8 n bits plus a fifth of the stuffable.
  double bit_rate_hz = 0.0;
  /// Frames one endpoint can have waiting for the bus; beyond it send() says would_block.
  std::size_t send_queue = 32;
  /// Frames one endpoint can leave unread; beyond it the newest are lost, as in a controller.
  std::size_t receive_queue = 4096;
  /// Chance of each frame to vanish, to be delivered twice, to arrive with one wrong data bit.
  double loss = 0.0;
  double duplication = 0.0;
  double corruption = 0.0;
  std::uint64_t seed = 1;
};

/// Frames handed to send() wait for the next deliver(), which runs the bus up to the clock's present: whenever the bus
/// is free the waiting frame with the lowest identifier wins (each endpoint offers its oldest; equal identifiers: the
/// endpoint that was made first) and reaches all other endpoints, stamped with the end of its transmission.
class VirtualCanBus {
 public:
  /// The clock must outlive the bus.
  explicit VirtualCanBus(const Clock& clock, const VirtualCanBusConfig& config = {});
  ~VirtualCanBus();
  VirtualCanBus(const VirtualCanBus&) = delete;
  VirtualCanBus& operator=(const VirtualCanBus&) = delete;

  /// A new participant. Lives as long as the bus.
  CanBus& make_endpoint();

  void deliver();

  /// Takes the whole bus down (bus-off, link down) or brings it up again. Going down loses all waiting frames.
  void set_up(bool up);
  /// The same for one endpoint only: its adapter is unplugged. Precondition: made by this bus.
  void set_endpoint_up(const CanBus& endpoint, bool up);

  /// What one endpoint's controller says of itself. Precondition: made by this bus.
  void set_error_passive(const CanBus& endpoint, bool passive);

  /// Changes the chances of loss, duplication and corruption from now on.
  void set_faults(double loss, double duplication, double corruption);
  /// The chance of a frame to be overtaken by the next one of the same endpoint.
  void set_reordering(double chance) { reordering_ = chance; }
  /// While set nothing leaves, as if nobody acknowledged: frames wait up to send_queue, and come out afterwards.
  void set_stuck(bool stuck) { stuck_ = stuck; }
  /// Frames for which `passes` is false vanish; an empty function lets all pass.
  void set_filter(std::function<bool(const CanFrame&)> passes) { filter_ = std::move(passes); }
  /// Changes frames on their way; an empty function lets all pass as they are.
  void set_tamper(std::function<void(CanFrame&)> change) { tamper_ = std::move(change); }
  /// Sees every frame that was on the bus, as it was on the bus.
  void set_tap(std::function<void(const StampedCanFrame&)> tap) { tap_ = std::move(tap); }

  std::uint64_t frames_lost() const { return lost_; }

 private:
  class Endpoint;

  std::optional<Stamp> next_start() const;
  Endpoint* arbitrate(Stamp start);
  void transmit(Endpoint& sender, Stamp end);
  void put_on_bus(const Endpoint& sender, const StampedCanFrame& received);
  Endpoint& find(const CanBus& endpoint);
  Duration wire_time(const CanFrame& frame) const;
  bool happens(double probability);

  const Clock& clock_;
  VirtualCanBusConfig config_;
  std::list<Endpoint> endpoints_;
  bool up_ = true;
  bool stuck_ = false;
  double reordering_ = 0.0;
  Stamp free_at_{};
  std::function<bool(const CanFrame&)> filter_;
  std::function<void(CanFrame&)> tamper_;
  std::function<void(const StampedCanFrame&)> tap_;
  std::mt19937_64 random_;
  std::uint64_t lost_ = 0;
};

}  // namespace hogline::hw::sim
