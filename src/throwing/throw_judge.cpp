#include "src/throwing/throw_judge.hpp"

#include <cmath>

#include "vision/geometry/pose.hpp"
#include "vision/geometry/sheet.hpp"

namespace hogline {

using servo::ThrowerState;

bool stone_moves(const hw::sim::Truth& truth) {
  constexpr double at_rest_mps = 1e-3;
  return !truth.held && std::hypot(truth.stone.vx_mps, truth.stone.vy_mps) > at_rest_mps;
}

ThrowJudge::ThrowJudge(const servo::ThrowerConfig& config, const hw::sim::Scenario& scenario,
                       const servo::ShotOrder& order, Stamp start)
    : release_(config.release), stone_radius_m_(scenario.stone.radius_m), order_(order), start_(start) {}

void ThrowJudge::watch(const hw::sim::Truth& truth, const servo::Thrower& thrower) {
  const ThrowerState state = thrower.state();
  if (!line_start_ && state > ThrowerState::align) {
    line_start_ = truth.body;
  }
  const double nearest_m = vision::rules::tee_to_hog_m - stone_radius_m_;
  if (truth.held && truth.stone.y_m > nearest_m) violation_ = true;
}

ThrowResult ThrowJudge::verdict(const hw::sim::Truth& truth, const servo::Thrower& thrower, Stamp now) const {
  ThrowResult r;
  r.hog_line_violation = violation_;
  r.stone_burned = truth.burned.has_value();
  r.abort = thrower.abort_reason();
  if (!r.abort && !thrower.finished()) r.abort = "the throw did not come to its end in time";
  for (const auto& entry : thrower.history()) {
    r.states.push_back({servo::to_string(entry.state), seconds(entry.since - start_)});
  }
  if (line_start_) r.yaw_after_alignment_rad = vision::wrapped(line_start_->yaw_rad - order_.heading_rad);
  if (truth.release) r.release = judge_release(*truth.release);
  r.stop_hog_distance_m = vision::rules::tee_to_hog_m - truth.body.y_m;
  if (!truth.held && !stone_moves(truth)) r.rest = truth.stone;
  r.sim_time_s = seconds(now - start_);
  r.ok = r.release && !r.hog_line_violation && !r.stone_burned && !r.abort && thrower.finished() &&
         std::abs(r.release->hog_distance_m - r.release->target_hog_distance_m) <= release_.tolerance_m;
  return r;
}

ReleaseOutcome ThrowJudge::judge_release(const hw::sim::ReleaseRecord& record) const {
  ReleaseOutcome o;
  o.hog_distance_m = record.hog_distance_m;
  o.target_hog_distance_m = release_.hog_distance_m;
  o.speed_error_mps = record.speed_mps - order_.speed_mps;
  o.heading_error_rad = vision::wrapped(record.heading_rad - order_.heading_rad);
  if (line_start_) {
    // Left of the line through the aligned body's place at the ordered heading: along (-cos, -sin) of it.
    const double dx = record.stone_x_m - order_.release_x_m.value_or(line_start_->x_m);
    const double dy = order_.release_x_m ? 0.0 : record.stone_y_m - line_start_->y_m;
    o.lateral_error_m = -dx * std::cos(order_.heading_rad) - dy * std::sin(order_.heading_rad);
  }
  const double sense = order_.curl == servo::Curl::counter_clockwise ? 1.0 : -1.0;
  o.spin_error_radps = sense * record.spin_radps - order_.spin_radps;
  return o;
}

}  // namespace hogline
