// Between which bounds the body's distance to the hog line lies. Bounds, not an estimate: nothing is averaged, so it
// shares no error with the controller's filters but that of the sensors themselves.
#pragma once

#include <deque>
#include <optional>

#include "servo/thrower_config.hpp"
#include "vision/percepts/sheet_pose.hpp"

namespace hogline::servo {

/// Distances of b's origin from the hog line's house-side edge; `nearest_m` is the smaller one.
struct HogBounds {
  double nearest_m = 0.0;
  double farthest_m = 0.0;
  double half_width_m() const { return (farthest_m - nearest_m) / 2.0; }
};

/// Two looks in a row that agree, carried on by the wheels with their bound: right as long as one of the two is. A look
/// that does not overlap with that is wrong, or the wheels have slipped: then both are believed possible, until looks
/// agree with each other again.
class PlaceBounds {
 public:
  explicit PlaceBounds(const SafetyConfig& config) : config_(config) {}

  /// Forward speed of the wheels since the last call. Stamps that do not grow are ignored.
  void wheels(Stamp stamp, double forward_mps);
  /// Precondition: view.ok and finite, sigma > 0. Ignored when older than half a second or already taken.
  void look(const SheetPosePercept& view);

  /// At the newest wheels' stamp; nothing before the first look.
  std::optional<HogBounds> now() const;
  /// The same, `ahead_s` later, if the wheels' speed changes by at most `change_mps2`.
  std::optional<HogBounds> ahead(double ahead_s, double change_mps2) const;
  double forward_mps() const { return forward_mps_; }
  double travelled_m() const { return travelled_m_; }  ///< forward, by the wheels, since construction
  /// Looks and wheels do not fit, and nobody knows yet which are right.
  bool in_doubt() const { return to_confirm_ > 0; }
  /// Looks in a row that no slip explains.
  int contradictions() const { return contradictions_; }

 private:
  struct Travelled {
    Stamp stamp{};
    double least_m = 0.0;
    double most_m = 0.0;
  };
  Travelled at(Stamp stamp) const;
  HogBounds carried(const HogBounds& bounds, const Travelled& since) const;

  SafetyConfig config_;
  std::deque<Travelled> history_;
  double forward_mps_ = 0.0;
  double travelled_m_ = 0.0;
  double least_cos_ = 1.0;  ///< of the heading, as last seen
  std::optional<HogBounds> bounds_;
  std::optional<HogBounds> newest_look_;  ///< carried to the same moment
  std::optional<Stamp> look_stamp_;
  int to_confirm_ = 0;
  int contradictions_ = 0;
};

}  // namespace hogline::servo
