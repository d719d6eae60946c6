#include "hw/digital_curling/client_message.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <vector>

namespace hogline::hw::digital_curling {
namespace {

using nlohmann::json;

constexpr int deepest = 8;
constexpr double fastest_mps = 10.0;
constexpr std::size_t longest_name = 64;
constexpr std::size_t longest_quote = 60;

struct Refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Foreign text as it may stand in a message: short, printable ASCII.
std::string printable(std::string_view text, std::size_t longest) {
  std::string shown(text.substr(0, longest));
  std::ranges::replace_if(
      shown, [](char c) { return c < 0x20 || c > 0x7e; }, '?');
  return text.size() > longest ? shown + "..." : shown;
}

std::string in_quotes(std::string_view text) { return "'" + printable(text, longest_quote) + "'"; }

/// The library takes the last of several equal keys without a word.
class KeyCheck {
 public:
  bool operator()(int depth, json::parse_event_t event, const json& value) {
    if (depth > deepest) throw Refused("it is nested too deeply");
    if (event == json::parse_event_t::object_start) seen_.emplace_back();
    if (event == json::parse_event_t::object_end) seen_.pop_back();
    if (event == json::parse_event_t::key && !seen_.back().insert(value.get<std::string>()).second)
      throw Refused("it has the key " + in_quotes(value.get<std::string>()) + " twice");
    return true;
  }

 private:
  std::vector<std::set<std::string>> seen_;
};

json parsed(std::string_view line) {
  try {
    return json::parse(line.begin(), line.end(), KeyCheck());
  } catch (const json::exception& e) {
    const std::string_view what = e.what();
    const auto bracket = what.find("] ");
    throw Refused("it is no JSON: " + printable(bracket == what.npos ? what : what.substr(bracket + 2), 160));
  }
}

const json& member(const json& object, const char* key, const std::string& path) {
  const auto found = object.find(key);
  if (found == object.end()) throw Refused(path + key + " is missing");
  return *found;
}

const json& object_member(const json& object, const char* key, const std::string& path) {
  const json& value = member(object, key, path);
  if (!value.is_object()) throw Refused(path + key + " must be an object");
  return value;
}

std::string text_member(const json& object, const char* key, const std::string& path) {
  const json& value = member(object, key, path);
  if (!value.is_string()) throw Refused(path + key + " must be a string");
  return value.get<std::string>();
}

double speed_member(const json& object, const char* key, const std::string& path) {
  const json& value = member(object, key, path);
  if (!value.is_number()) throw Refused(path + key + " must be a number");
  const double speed = value.get<double>();
  if (!std::isfinite(speed) || std::abs(speed) > fastest_mps)
    throw Refused(path + key + " must be between -10 and 10 m/s");
  return speed;
}

void nothing_but(const json& object, std::initializer_list<std::string_view> keys, const std::string& path) {
  for (const auto& [key, value] : object.items()) {
    if (std::ranges::find(keys, key) == keys.end()) throw Refused(path + printable(key, longest_quote) + " is unknown");
  }
}

servo::Curl curl_of(const std::string& rotation) {
  if (rotation == "cw") return servo::Curl::clockwise;
  if (rotation == "ccw") return servo::Curl::counter_clockwise;
  throw Refused("move.rotation must be 'cw' or 'ccw', not " + in_quotes(rotation));
}

ClientMessage dc_ok(const json& message) {
  std::string name = text_member(message, "name", "");
  if (name.size() > longest_name) throw Refused("name must have at most 64 bytes");
  const auto control = [](char c) { return (c >= 0 && c < 0x20) || c == 0x7f; };
  if (std::ranges::any_of(name, control)) throw Refused("name must have no control characters");
  return DcOk{std::move(name)};
}

ClientMessage ready_ok(const json& message) {
  const json& order = member(message, "player_order", "");
  const std::string what = "player_order must be the numbers 0 to 3 in some order";
  if (!order.is_array() || order.size() != 4) throw Refused(what);
  ReadyOk ready;
  std::set<int> players;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!order[i].is_number_integer() || order[i] < 0 || order[i] > 3) throw Refused(what);
    ready.player_order[i] = order[i].get<int>();
    players.insert(ready.player_order[i]);
  }
  if (players.size() != 4) throw Refused(what);
  return ready;
}

ClientMessage move(const json& message) {
  const json& wanted = object_member(message, "move", "");
  const std::string type = text_member(wanted, "type", "move.");
  if (type == "concede") {
    nothing_but(wanted, {"type"}, "move.");
    return servo::GameMove(servo::Concession{});
  }
  if (type != "shot") throw Refused("move.type must be 'shot' or 'concede', not " + in_quotes(type));
  nothing_but(wanted, {"type", "velocity", "rotation"}, "move.");
  const json& velocity = object_member(wanted, "velocity", "move.");
  nothing_but(velocity, {"x", "y"}, "move.velocity.");
  return servo::GameMove(servo::HackShot{speed_member(velocity, "x", "move.velocity."),
                                         speed_member(velocity, "y", "move.velocity."),
                                         curl_of(text_member(wanted, "rotation", "move."))});
}

ClientMessage understood(std::string_view line, Due due) {
  const json message = parsed(line);
  if (!message.is_object()) throw Refused("it is no object");
  const std::string cmd = text_member(message, "cmd", "");
  const char* const expected = due == Due::dc_ok ? "dc_ok" : due == Due::ready_ok ? "ready_ok" : "move";
  if (cmd != expected) throw Refused("cmd must be '" + std::string(expected) + "' now, not " + in_quotes(cmd));
  return due == Due::dc_ok ? dc_ok(message) : due == Due::ready_ok ? ready_ok(message) : move(message);
}

}  // namespace

Decoded decode(std::string_view line, Due due) {
  try {
    return {understood(line, due), {}};
  } catch (const Refused& refused) {
    return {std::nullopt, refused.what()};
  }
}

}  // namespace hogline::hw::digital_curling
