#include "servo/safety/place_bounds.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace hogline::servo {
namespace {

constexpr Duration history_span = std::chrono::milliseconds(500);
constexpr double heading_margin_rad = 0.035;  // two degrees, since the last look
constexpr int confirming_looks = 3;

bool overlap(const HogBounds& a, const HogBounds& b) {
  return a.nearest_m <= b.farthest_m && b.nearest_m <= a.farthest_m;
}

double gap_m(const HogBounds& a, const HogBounds& b) {
  return std::max(a.nearest_m - b.farthest_m, b.nearest_m - a.farthest_m);
}

HogBounds hull(const HogBounds& a, const HogBounds& b) {
  return {std::min(a.nearest_m, b.nearest_m), std::max(a.farthest_m, b.farthest_m)};
}

// Of two that overlap.
HogBounds common(const HogBounds& a, const HogBounds& b) {
  return {std::max(a.nearest_m, b.nearest_m), std::min(a.farthest_m, b.farthest_m)};
}

}  // namespace

void PlaceBounds::wheels(Stamp stamp, double forward_mps) {
  if (history_.empty()) {
    history_.push_back({stamp, 0.0, 0.0});
    forward_mps_ = forward_mps;
    return;
  }
  const Travelled before = history_.back();
  if (stamp <= before.stamp) return;
  const double way_m = 0.5 * (forward_mps_ + forward_mps) * seconds(stamp - before.stamp);
  const double error_m = std::abs(way_m) * config_.odometry_bound;
  const double least_m = (way_m > 0.0 ? least_cos_ * way_m : way_m) - error_m;
  const double most_m = (way_m > 0.0 ? way_m : least_cos_ * way_m) + error_m;
  history_.push_back({stamp, before.least_m + least_m, before.most_m + most_m});
  forward_mps_ = forward_mps;
  travelled_m_ += way_m;
  if (bounds_) bounds_ = carried(*bounds_, before);
  if (newest_look_) newest_look_ = carried(*newest_look_, before);
  while (history_.size() > 2 && history_[1].stamp < stamp - history_span) history_.pop_front();
}

PlaceBounds::Travelled PlaceBounds::at(Stamp stamp) const {
  const auto after = std::find_if(history_.begin(), history_.end(), [&](const auto& h) { return h.stamp >= stamp; });
  if (after == history_.end()) return history_.back();
  if (after == history_.begin()) return history_.front();
  const auto before = after - 1;
  const double part = seconds(stamp - before->stamp) / seconds(after->stamp - before->stamp);
  return {stamp, before->least_m + part * (after->least_m - before->least_m),
          before->most_m + part * (after->most_m - before->most_m)};
}

HogBounds PlaceBounds::carried(const HogBounds& bounds, const Travelled& since) const {
  const Travelled& newest = history_.back();
  return {bounds.nearest_m - (newest.most_m - since.most_m), bounds.farthest_m - (newest.least_m - since.least_m)};
}

void PlaceBounds::look(const SheetPosePercept& view) {
  assert(view.ok && std::isfinite(view.hog_distance_m) && view.hog_distance_sigma_m > 0.0);
  if (history_.empty() || view.stamp < history_.front().stamp - history_span) return;
  if (look_stamp_ && view.stamp <= *look_stamp_) return;
  if (bounds_ && view.stamp < history_.front().stamp) return;
  look_stamp_ = view.stamp;
  least_cos_ = std::max(0.0, std::cos(std::abs(view.body.yaw_rad) + heading_margin_rad));

  const double margin_m = config_.look_sigmas * view.hog_distance_sigma_m + config_.look_margin_m;
  const HogBounds seen = carried({view.hog_distance_m - margin_m, view.hog_distance_m + margin_m}, at(view.stamp));
  const std::optional<HogBounds> last = newest_look_;
  newest_look_ = seen;
  if (!bounds_) {
    bounds_ = seen;
    return;
  }
  const double apart_m = gap_m(*bounds_, seen);
  contradictions_ = apart_m > config_.slip_allowance_m ? contradictions_ + 1 : 0;
  if (contradictions_ > 0) return;
  if (apart_m > 0.0) {
    bounds_ = hull(*bounds_, seen);
    to_confirm_ = confirming_looks;
    return;
  }
  if (!last || !overlap(*last, seen)) return;
  if (to_confirm_ > 0 && --to_confirm_ > 0) return;
  bounds_ = common(*bounds_, hull(*last, seen));
}

std::optional<HogBounds> PlaceBounds::now() const { return bounds_; }

std::optional<HogBounds> PlaceBounds::ahead(double ahead_s, double change_mps2) const {
  if (!bounds_) return std::nullopt;
  const double way_m = forward_mps_ * ahead_s;
  const double error_m = std::abs(way_m) * config_.odometry_bound + 0.5 * change_mps2 * ahead_s * ahead_s;
  const double a_m = way_m - error_m;
  const double b_m = way_m + error_m;
  return HogBounds{bounds_->nearest_m - b_m, bounds_->farthest_m - (a_m > 0.0 ? least_cos_ * a_m : a_m)};
}

}  // namespace hogline::servo
