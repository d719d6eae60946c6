#include "src/demo_command.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "src/exit_status.hpp"
#include "src/throw_request.hpp"
#include "vision/geometry/sheet.hpp"

namespace hogline {
namespace {

constexpr double deg = 180.0 / std::numbers::pi;

void tell_order(const servo::ShotOrder& order) {
  fmt::print("The order: {:.2f} m/s at the release, {:+.2f} deg, curl {}, {:.1f} rad/s of spin.\n\n", order.speed_mps,
             order.heading_rad * deg, order.curl == servo::Curl::clockwise ? "cw" : "ccw", order.spin_radps);
}

void tell_release(const ReleaseOutcome& r) {
  fmt::print("Released {:.3f} m before the hog line (ordered {:.3f}), measured against the simulator's truth:\n",
             r.hog_distance_m, r.target_hog_distance_m);
  fmt::print("  place    {:+8.1f} mm\n", 1000.0 * (r.hog_distance_m - r.target_hog_distance_m));
  fmt::print("  speed    {:+8.1f} mm/s\n", 1000.0 * r.speed_error_mps);
  fmt::print("  heading  {:+8.3f} deg\n", r.heading_error_rad * deg);
  fmt::print("  lateral  {:+8.1f} mm\n", 1000.0 * r.lateral_error_m);
  fmt::print("  spin     {:+8.3f} rad/s\n", r.spin_error_radps);
}

void tell_rest(const hw::sim::StoneTruth& stone) {
  using vision::rules::tee_to_tee_m;
  if (std::abs(stone.x_m) > vision::rules::max_width_m / 2.0 ||
      stone.y_m > tee_to_tee_m + vision::rules::tee_to_back_m) {
    fmt::print("The stone left the sheet.\n");
    return;
  }
  const double to_tee_m = std::hypot(stone.x_m, stone.y_m - tee_to_tee_m);
  fmt::print("The stone lies still {:.2f} m from the far tee ({:+.2f} m across, {:+.2f} m along).\n", to_tee_m,
             stone.x_m, stone.y_m - tee_to_tee_m);
}

void tell(const ThrowResult& result, const std::string& folder) {
  for (const StateTime& s : result.states) fmt::print("  {:6.2f} s  {}\n", s.t_s, s.name);
  fmt::print("\n");
  if (result.yaw_after_alignment_rad) {
    fmt::print("After the alignment the body stood {:+.3f} deg off the ordered heading.\n",
               *result.yaw_after_alignment_rad * deg);
  }
  if (result.release) tell_release(*result.release);
  if (result.abort) fmt::print("Aborted: {}. The stone was {}.\n", *result.abort, result.release ? "let go" : "kept");
  if (result.hog_line_violation) fmt::print("HOG LINE VIOLATION: the stone was held too far.\n");
  if (result.stone_burned) fmt::print("BURNED: the robot touched the stone after the release.\n");
  if (result.rest) tell_rest(*result.rest);
  fmt::print("\n{:.1f} s simulated in {:.1f} s. Everything is in {}: begin with {}/overview.png.\n", result.sim_time_s,
             result.wall_time_s, folder, folder);
}

}  // namespace

int run_demo(const ThrowOptions& options) {
  const ThrowRequest request = make_request(options);
  tell_order(request.order);
  const ThrowOutcome outcome = carry_out(options, request);
  tell(outcome.result, options.out);
  return outcome.result.ok ? ExitStatus::success : ExitStatus::not_achieved;
}

}  // namespace hogline
