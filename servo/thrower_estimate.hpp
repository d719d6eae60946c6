// What the thrower believes: heading, distance to the hog line, offset from the shot's line, all from one observation
// after the other.
#pragma once

#include <optional>

#include "servo/heading_filter.hpp"
#include "servo/hog_distance_filter.hpp"
#include "servo/line_tracking.hpp"
#include "servo/observation.hpp"
#include "servo/place_average.hpp"
#include "servo/shot.hpp"
#include "servo/thrower_config.hpp"
#include "servo/unicycle.hpp"

namespace hogline::servo {

/// What may be believed of the present observation.
struct EstimateUse {
  bool standing = false;  ///< the body is ordered to stand: rest is believed when the wheels say so
  bool near_view = false;
  bool low_view = false;
};

class ThrowerEstimate {
 public:
  ThrowerEstimate(const ThrowerConfig& config, Stamp start);

  /// Takes what is new in an observation whose inputs have been judged good.
  void update(const ThrowerObservation& observation, const EstimateUse& use);

  /// The heading is known from here on.
  void start_heading(Stamp now, const StandingPlace& place);
  /// The order's line is laid, and the run's filters start from the place. `now`: the body still stands there.
  void start_line(Stamp now, const StandingPlace& place, const ShotOrder& order);

  HeadingEstimate heading(Stamp now) const { return heading_.at(now); }
  const PlanarTwist& odometry() const { return odometry_; }
  double resting_s() const { return resting_s_; }  ///< how long the wheels have been at rest while ordered to stand
  /// Precondition for these two: start_line().
  const HogDistanceFilter& hog_distance() const { return *hog_distance_; }
  const LateralFilter& lateral() const { return *lateral_; }
  bool on_line() const { return hog_distance_.has_value(); }
  /// What the slip watch says of the wheels, until it says otherwise.
  void wheels_slip(bool slipping) { slipping_ = slipping; }
  /// Stamp of the newest low view in which the sheet was seen.
  std::optional<Stamp> last_sight() const { return last_sight_; }

  /// Why sight and dead reckoning can not both be right; empty while they can.
  std::optional<std::string> contradiction() const;

 private:
  void take_wheels(const WheelObservation& wheels, bool standing);
  void take_gyro(const GyroObservation& gyro, bool standing);
  void take_near_view(const SheetPosePercept& view);
  void take_low_view(const SheetPosePercept& view);

  ThrowerConfig config_;
  HeadingFilter heading_;
  std::optional<HogDistanceFilter> hog_distance_;
  std::optional<LateralFilter> lateral_;
  PlanarTwist odometry_;
  double resting_s_ = 0.0;
  std::optional<Stamp> wheels_stamp_;
  std::optional<Stamp> near_stamp_;
  std::optional<Stamp> low_stamp_;
  std::optional<Stamp> last_sight_;
  bool slipping_ = false;
};

}  // namespace hogline::servo
