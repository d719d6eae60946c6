// Each message to the wire and back. What can not be said within the bounds is not written; what came in outside them
// is not read: non-finite numbers, words that are none, endless lists.
#pragma once

#include <functional>
#include <optional>

#include "hogline_msgs.h"
#include "hw/team_messages.hpp"

namespace hogline::hw::link {

/// Hands the wire's C struct of the message's kind to `write`, with all it points to alive until `write` returns.
/// False, and `write` is not called: the message is not finite or breaks a bound.
bool with_wire(const TeamMessage& message, const std::function<void(const void* sample)>& write);

std::optional<TeamMessage> plain(const hogline_msgs_msg_dds__ShotOrder_& wire);
std::optional<TeamMessage> plain(const hogline_msgs_msg_dds__ThrowerState_& wire);
std::optional<TeamMessage> plain(const hogline_msgs_msg_dds__Release_& wire);
std::optional<TeamMessage> plain(const hogline_msgs_msg_dds__Board_& wire);
std::optional<TeamMessage> plain(const hogline_msgs_msg_dds__StoneTrack_& wire);
std::optional<TeamMessage> plain(const hogline_msgs_msg_dds__Outcome_& wire);
std::optional<TeamMessage> plain(const hogline_msgs_msg_dds__Heartbeat_& wire);
std::optional<TeamMessage> plain(const hogline_msgs_msg_dds__EmergencyStop_& wire);

}  // namespace hogline::hw::link
