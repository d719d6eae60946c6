// What a client of a Digital Curling game may say, and how a line of foreign bytes becomes it or is refused.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "servo/game/hack_shot.hpp"

namespace hogline::hw::digital_curling {

struct DcOk {
  std::string name;
};
struct ReadyOk {
  std::array<int, 4> player_order{};
};
using ClientMessage = std::variant<DcOk, ReadyOk, servo::GameMove>;

/// Which of them is due.
enum class Due { dc_ok, ready_ok, move };

struct Decoded {
  std::optional<ClientMessage> message;
  std::string problem;  ///< exactly when there is no message: what was wrong, in printable ASCII
};

/// Strict: JSON by the letter, no key twice, every value of its type and in its range; unknown keys are refused in a
/// move and passed over elsewhere. A velocity's parts are between -10 and 10 m/s, a name has at most 64 bytes.
Decoded decode(std::string_view line, Due due);

}  // namespace hogline::hw::digital_curling
