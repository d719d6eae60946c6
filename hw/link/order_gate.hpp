// Which shot orders a thrower may take at all. The seed has no such thing; the rules are what a replayed, doubled,
// reordered or late order, or a second commander, would do to a robot of 100 kg.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hw/team_messages.hpp"

namespace hogline::hw::link {

struct OrderGateConfig {
  std::string commander;      ///< the only robot whose orders count
  std::uint64_t session = 0;  ///< the thrower's own, which an order must name
  Duration longest_age{};     ///< from the order's making to its arrival, in one clock
  Duration commander_gone{};  ///< silence after which a commander that was started anew is believed
};

/// One order's judgement.
struct OrderVerdict {
  bool accepted = false;
  std::string reason;  ///< why not, when refused
};

/// Accepts an order once. Time is an argument.
class OrderGate {
 public:
  explicit OrderGate(OrderGateConfig config) : config_(std::move(config)) {}

  /// The commander was heard, with whatever kind of message, in this session of its.
  void heard(const Origin& origin, Stamp now);

  /// `sent`: the order's stamp in this machine's clock; empty while the clocks' offset is not known.
  OrderVerdict judge(const ShotOrderMessage& order, std::optional<Stamp> sent, Stamp now);

 private:
  OrderVerdict judge_sender(const Origin& origin, Stamp now) const;

  OrderGateConfig config_;
  std::uint64_t commander_session_ = 0;  ///< 0: none yet
  Stamp commander_heard_{};
  std::uint64_t last_serial_ = 0;
};

}  // namespace hogline::hw::link
