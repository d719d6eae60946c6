// Port: the robots' link. Carries messages; what they allow or forbid is decided by those who receive them.
#pragma once

#include <optional>
#include <string>

#include "hw/device_status.hpp"
#include "hw/team_messages.hpp"

namespace hogline::hw {

/// A message that came in whole and within the bounds of its kind.
struct ReceivedMessage {
  TeamMessage message;
  Stamp received{};  ///< in this machine's steady clock, when it was taken from the link
};

/// What came of a message handed to send().
enum class TeamSendResult {
  sent,       ///< handed to the transport, which repeats it until it is heard where its kind is reliable
  refused,    ///< not finite, or longer than its kind allows: nobody would accept it
  forbidden,  ///< this robot's keys do not allow it to say such a thing
  down,       ///< the link is broken; state() says why
};

struct TeamLinkState {
  std::uint64_t session = 0;  ///< this start's, as the origin of each message gives it
  long sent = 0;
  long received = 0;
  long malformed = 0;                ///< came in and was dropped: not finite, too long, unknown words
  long impostors = 0;                ///< came in and was dropped: said under a name that is not its writer's
  std::optional<DeviceError> error;  ///< latched
};

/// No call blocks.
class TeamLink {
 public:
  virtual ~TeamLink() = default;
  /// Stamps and numbers the message. `at`: when what it tells happened.
  virtual TeamSendResult send(TeamMessage message, Stamp at) = 0;
  /// The oldest message received and not yet read, or nothing. One's own do not come back.
  virtual std::optional<ReceivedMessage> receive(Stamp now) = 0;
  virtual TeamLinkState state() const = 0;
  /// This machine's steady clock in its team time, as the stamps of its messages are made.
  virtual TeamTime team_time(Stamp at) const = 0;
};

}  // namespace hogline::hw
