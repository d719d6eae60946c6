#include "hw/link/message_bounds.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "hw/link/wire_values.hpp"

namespace hogline::hw::link {
namespace {

bool is_text(const std::string& text, std::size_t longest) {
  return text.size() <= longest && text.find('\0') == std::string::npos;
}

bool is_one_of(const std::string& word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_time(TeamTime time) { return time >= TeamTime{} && time < TeamTime{std::chrono::seconds{INT32_MAX}}; }

bool is_span(const std::optional<double>& span_s) { return !span_s || (all_finite({*span_s}) && *span_s >= 0.0); }

bool fine(const Origin& o) { return !o.robot.empty() && is_text(o.robot, longest_name) && is_time(o.stamp); }

bool fine(const ShotOrderMessage& m) { return all_finite({m.speed_mps, m.heading_rad, m.spin_radps}); }

bool fine(const ThrowerStateMessage& m) { return is_text(m.reason, longest_text); }

bool fine(const ReleaseMessage& m) {
  return all_finite({m.hog_distance_m, m.lateral_m, m.speed_mps, m.heading_rad, m.spin_radps});
}

bool fine(const TeamStone& s) {
  return all_finite({s.x_m, s.y_m}) && all_finite(s.covariance_m2) && is_one_of(s.team, {"first", "second", "unknown"});
}

bool fine(const BoardMessage& m) {
  return is_text(m.reason, longest_text) && m.stones.size() <= most_stones &&
         std::all_of(m.stones.begin(), m.stones.end(), [](const TeamStone& s) { return fine(s); });
}

bool fine(const StoneTrackMessage& m) {
  return all_finite({m.x_m, m.y_m, m.vx_mps, m.vy_mps}) && all_finite(m.place_covariance_m2) &&
         all_finite(m.velocity_covariance_m2ps2);
}

bool fine(const OutcomeMessage& m) {
  return is_text(m.reason, longest_text) &&
         is_one_of(m.fate, {"", "at_rest", "hogged", "sideline", "through", "lost"}) && m.ok == !m.fate.empty() &&
         all_finite({m.x_m, m.y_m, m.curl_m.value_or(0.0)}) && is_span(m.hog_to_hog_s) && is_span(m.hog_to_rest_s);
}

bool fine(const HeartbeatMessage& m) {
  return m.echoes.size() <= most_echoes && std::all_of(m.echoes.begin(), m.echoes.end(), [](const Echo& e) {
           return is_text(e.robot, longest_name) && is_time(e.sent) && is_time(e.heard);
         });
}

bool fine(const EmergencyStopMessage& m) { return is_text(m.reason, longest_text); }

}  // namespace

bool within_bounds(const TeamMessage& message) {
  return std::visit([](const auto& m) { return fine(m.origin) && fine(m); }, message);
}

}  // namespace hogline::hw::link
