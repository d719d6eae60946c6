#include "src/throwing/throw_log.hpp"

#include <fmt/format.h>

#include <iterator>
#include <numbers>

#include "src/output/output_file.hpp"

namespace hogline {

void ThrowLog::write_csv(const std::string& path) const {
  constexpr double deg = 180.0 / std::numbers::pi;
  std::string text =
      "t_s,state,true_x_m,true_y_m,true_yaw_deg,true_speed_mps,true_hog_distance_m,stone_x_m,stone_y_m,stone_held,"
      "believed_yaw_deg,believed_hog_distance_m,believed_speed_mps,speed_setpoint_mps\n";
  for (const ThrowSample& s : samples) {
    fmt::format_to(std::back_inserter(text),
                   "{:.3f},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{},{:.4f},{:.4f},{:.4f},{:.4f}\n", s.t_s,
                   servo::to_string(s.state), s.true_body.x_m, s.true_body.y_m, s.true_body.yaw_rad * deg,
                   s.true_speed_mps, s.true_hog_distance_m, s.stone_x_m, s.stone_y_m, s.stone_held ? 1 : 0,
                   s.believed_yaw_rad * deg, s.believed_hog_distance_m, s.believed_speed_mps, s.speed_setpoint_mps);
  }
  write_text(path, text);
}

}  // namespace hogline
