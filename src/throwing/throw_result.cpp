#include "src/throwing/throw_result.hpp"

#include <nlohmann/json.hpp>
#include <numbers>

namespace hogline {
namespace {

using nlohmann::ordered_json;

constexpr double deg = 180.0 / std::numbers::pi;

template <typename T>
ordered_json or_null(const std::optional<T>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json release_json(const ReleaseOutcome& r) {
  return {{"hog_distance_m", r.hog_distance_m},
          {"target_hog_distance_m", r.target_hog_distance_m},
          {"error_mm", 1000.0 * (r.hog_distance_m - r.target_hog_distance_m)},
          {"speed_error_mps", r.speed_error_mps},
          {"heading_error_deg", r.heading_error_rad * deg},
          {"lateral_error_mm", 1000.0 * r.lateral_error_m},
          {"spin_error_radps", r.spin_error_radps}};
}

ordered_json realtime_json(const RealtimeFigures& r) {
  return {{"commands", r.commands},
          {"frame_to_command_p50_ms", r.frame_to_command_p50_ms},
          {"frame_to_command_p99_ms", r.frame_to_command_p99_ms},
          {"look_to_command_p50_ms", r.look_to_command_p50_ms},
          {"look_to_command_p99_ms", r.look_to_command_p99_ms},
          {"looks", r.looks},
          {"periods", r.periods},
          {"late_p99_ms", r.late_p99_ms},
          {"late_max_ms", r.late_max_ms},
          {"scheduled_first", r.scheduled_first}};
}

}  // namespace

std::string result_line(const ThrowResult& result) {
  ordered_json line;
  line["ok"] = result.ok;
  line["release"] = result.release ? release_json(*result.release) : ordered_json(nullptr);
  line["hog_line_violation"] = result.hog_line_violation;
  line["stone_burned"] = result.stone_burned;
  line["yaw_after_alignment_deg"] =
      result.yaw_after_alignment_rad ? ordered_json(*result.yaw_after_alignment_rad * deg) : ordered_json(nullptr);
  line["states"] = ordered_json::array();
  for (const StateTime& s : result.states) line["states"].push_back({{"name", s.name}, {"t_s", s.t_s}});
  line["abort"] = or_null(result.abort);
  line["device_errors"] = result.device_errors;
  line["stop_hog_distance_m"] = result.stop_hog_distance_m;
  line["rest"] =
      result.rest ? ordered_json{{"x_m", result.rest->x_m}, {"y_m", result.rest->y_m}} : ordered_json(nullptr);
  line["rehearsed_delays_s"] = result.rehearsed_delays_s;
  line["believed_delay_s"] = or_null(result.believed_delay_s);
  line["measured_delay_s"] = or_null(result.measured_delay_s);
  if (result.fault_struck) line["fault_struck"] = *result.fault_struck;
  if (result.realtime) line["realtime"] = realtime_json(*result.realtime);
  line["sim_time_s"] = result.sim_time_s;
  line["wall_time_s"] = result.wall_time_s;
  return line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace hogline
