#include "hw/sim/virtual_can_bus.hpp"

#include <algorithm>
#include <cassert>

namespace hogline::hw::sim {

class VirtualCanBus::Endpoint final : public CanBus {
 public:
  explicit Endpoint(VirtualCanBus& bus) : bus_(bus) {}

  CanSendResult send(const CanFrame& frame) override {
    if (!up()) return CanSendResult::bus_down;
    if (waiting.size() >= bus_.config_.send_queue) return CanSendResult::would_block;
    waiting.push_back({frame, bus_.clock_.now()});
    return CanSendResult::sent;
  }

  std::optional<StampedCanFrame> receive() override {
    if (unread.empty()) return std::nullopt;
    const StampedCanFrame oldest = unread.front();
    unread.pop_front();
    return oldest;
  }

  bool up() const override { return bus_.up_ && plugged; }
  bool error_passive() const override { return passive; }

  void take(const StampedCanFrame& received) {
    if (!plugged) return;
    if (unread.size() < bus_.config_.receive_queue) unread.push_back(received);
  }

  bool plugged = true;
  bool passive = false;
  std::deque<StampedCanFrame> waiting;  ///< stamped with the moment of send()
  std::deque<StampedCanFrame> unread;

 private:
  VirtualCanBus& bus_;
};

VirtualCanBus::VirtualCanBus(const Clock& clock, const VirtualCanBusConfig& config)
    : clock_(clock), config_(config), random_(config.seed) {}
VirtualCanBus::~VirtualCanBus() = default;

CanBus& VirtualCanBus::make_endpoint() { return endpoints_.emplace_back(*this); }

void VirtualCanBus::deliver() {
  while (up_ && !stuck_) {
    const std::optional<Stamp> start = next_start();
    if (!start) return;
    Endpoint* sender = arbitrate(*start);
    if (!sender) return;
    const Stamp end = *start + wire_time(sender->waiting.front().frame);
    if (end > clock_.now()) return;
    free_at_ = end;
    transmit(*sender, end);
  }
}

/// When the bus is free and somebody has something to send.
std::optional<Stamp> VirtualCanBus::next_start() const {
  std::optional<Stamp> oldest;
  for (const Endpoint& endpoint : endpoints_) {
    if (endpoint.waiting.empty()) continue;
    const Stamp queued = endpoint.waiting.front().stamp;
    if (!oldest || queued < *oldest) oldest = queued;
  }
  if (!oldest) return std::nullopt;
  return std::max(free_at_, *oldest);
}

VirtualCanBus::Endpoint* VirtualCanBus::arbitrate(Stamp start) {
  // A 29-bit identifier is compared by its first eleven bits, and loses against an equal base identifier.
  const auto priority = [](const CanFrame& frame) {
    return frame.extended ? (std::uint64_t{frame.id} << 1) | 1u : std::uint64_t{frame.id} << 19;
  };
  Endpoint* winner = nullptr;
  std::uint64_t best = 0;
  for (Endpoint& endpoint : endpoints_) {
    if (endpoint.waiting.empty() || endpoint.waiting.front().stamp > start) continue;
    const std::uint64_t offered = priority(endpoint.waiting.front().frame);
    if (winner && offered >= best) continue;
    winner = &endpoint;
    best = offered;
  }
  return winner;
}

void VirtualCanBus::transmit(Endpoint& sender, Stamp end) {
  if (sender.waiting.size() > 1 && happens(reordering_)) std::swap(sender.waiting[0].frame, sender.waiting[1].frame);
  StampedCanFrame received{sender.waiting.front().frame, end};
  sender.waiting.pop_front();

  if ((filter_ && !filter_(received.frame)) || happens(config_.loss)) {
    ++lost_;
    return;
  }
  if (happens(config_.corruption) && received.frame.length > 0) {
    const auto bit = static_cast<std::size_t>(random_() % (std::uint64_t{8} * received.frame.length));
    received.frame.data[bit / 8] ^= static_cast<std::uint8_t>(1u << (bit % 8));
  }
  if (tamper_) tamper_(received.frame);
  const int copies = happens(config_.duplication) ? 2 : 1;
  for (int i = 0; i < copies; ++i) put_on_bus(sender, received);
}

void VirtualCanBus::put_on_bus(const Endpoint& sender, const StampedCanFrame& received) {
  if (tap_) tap_(received);
  for (Endpoint& endpoint : endpoints_) {
    if (&endpoint != &sender) endpoint.take(received);
  }
}

Duration VirtualCanBus::wire_time(const CanFrame& frame) const {
  if (config_.bit_rate_hz <= 0.0) return Duration{0};
  const int data_bits = frame.remote ? 0 : 8 * frame.length;
  const double fixed_bits = frame.extended ? 67.0 : 47.0;
  const double stuffed_bits = 0.2 * 0.5 * ((frame.extended ? 54.0 : 34.0) + data_bits);  // half of the worst case
  return from_seconds((fixed_bits + data_bits + stuffed_bits) / config_.bit_rate_hz);
}

bool VirtualCanBus::happens(double probability) {
  if (probability <= 0.0) return false;
  return static_cast<double>(random_() >> 11) * 0x1.0p-53 < probability;
}

void VirtualCanBus::set_up(bool up) {
  up_ = up;
  if (up) return;
  for (Endpoint& endpoint : endpoints_) endpoint.waiting.clear();
}

VirtualCanBus::Endpoint& VirtualCanBus::find(const CanBus& endpoint) {
  const auto found = std::find_if(endpoints_.begin(), endpoints_.end(), [&endpoint](const Endpoint& candidate) {
    return static_cast<const CanBus*>(&candidate) == &endpoint;
  });
  assert(found != endpoints_.end() && "not an endpoint of this bus");
  return *found;
}

void VirtualCanBus::set_endpoint_up(const CanBus& endpoint, bool up) {
  Endpoint& found = find(endpoint);
  found.plugged = up;
  if (!up) found.waiting.clear();
}

void VirtualCanBus::set_error_passive(const CanBus& endpoint, bool passive) { find(endpoint).passive = passive; }

void VirtualCanBus::set_faults(double loss, double duplication, double corruption) {
  config_.loss = loss;
  config_.duplication = duplication;
  config_.corruption = corruption;
}

}  // namespace hogline::hw::sim
