#include "hw/link/order_gate.hpp"

#include <fmt/format.h>

namespace hogline::hw::link {
namespace {

OrderVerdict refused(std::string reason) { return {.accepted = false, .reason = std::move(reason)}; }

}  // namespace

void OrderGate::heard(const Origin& origin, Stamp now) {
  if (origin.robot != config_.commander) return;
  const bool gone = commander_session_ != 0 && now - commander_heard_ > config_.commander_gone;
  if (commander_session_ == 0 || (gone && origin.session > commander_session_)) {
    commander_session_ = origin.session;
    last_serial_ = 0;
  }
  if (origin.session == commander_session_) commander_heard_ = now;
}

OrderVerdict OrderGate::judge_sender(const Origin& origin, Stamp now) const {
  if (origin.robot != config_.commander) {
    return refused(fmt::format("an order from '{}': only '{}' commands", origin.robot, config_.commander));
  }
  if (commander_session_ == 0) return refused(fmt::format("'{}' has not been heard yet", origin.robot));
  if (origin.session < commander_session_) {
    return refused(fmt::format("an order of an earlier start of '{}'", origin.robot));
  }
  if (origin.session > commander_session_) {
    return refused(fmt::format("a second '{}' commands while the first is still heard", origin.robot));
  }
  if (now - commander_heard_ > config_.commander_gone) {
    return refused(fmt::format("'{}' has been silent for {:.1f} s", origin.robot, seconds(now - commander_heard_)));
  }
  return {.accepted = true, .reason = {}};
}

OrderVerdict OrderGate::judge(const ShotOrderMessage& order, std::optional<Stamp> sent, Stamp now) {
  if (OrderVerdict sender = judge_sender(order.origin, now); !sender.accepted) return sender;
  if (order.thrower_session != config_.session) return refused("an order for another start of this thrower");
  if (order.origin.serial == last_serial_) {
    return refused(fmt::format("order {} came before: it is thrown once", order.origin.serial));
  }
  if (order.origin.serial < last_serial_) {
    return refused(fmt::format("order {} is older than order {}", order.origin.serial, last_serial_));
  }
  if (!sent) return refused("the offset between the two clocks is not known yet");
  if (now - *sent > config_.longest_age) {
    return refused(fmt::format("an order that is {:.1f} s old", seconds(now - *sent)));
  }
  if (*sent - now > config_.longest_age) {
    return refused(fmt::format("an order from {:.1f} s ahead: a clock is wrong", seconds(*sent - now)));
  }
  last_serial_ = order.origin.serial;
  return {.accepted = true, .reason = {}};
}

}  // namespace hogline::hw::link
