// Holds the shot's line during the run: heading from the fused estimate, lateral offset from odometry and low views.
#pragma once

#include "servo/thrower_config.hpp"
#include "vision/percepts/sheet_pose.hpp"

namespace hogline::servo {

/// A line in e: through a place, along a heading.
struct ShotLine {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;

  /// Distance of a place from the line, left positive.
  double lateral_m(double at_x_m, double at_y_m) const;
  /// x of the place that is off the line by that much, at this y.
  double x_at_m(double at_y_m, double lateral_m) const;
};

/// Lateral offset from the line: carried by speed and heading, corrected by sheet poses.
class LateralFilter {
 public:
  /// `lateral_m`: at the start.
  LateralFilter(const ShotLine& line, const OdometryConfig& config, double lateral_m, double sigma_m);
  void advance(double speed_mps, double heading_rad, double heading_sigma_rad, double dt_s);
  /// Precondition: pose.ok, finite, sigmas > 0. False: gated.
  bool correct(const SheetPosePercept& pose);
  double lateral_m() const { return lateral_m_; }
  const ShotLine& line() const { return line_; }
  double variance_m2() const { return variance_m2_; }

 private:
  ShotLine line_;
  OdometryConfig config_;
  double lateral_m_;
  double variance_m2_;
};

/// Cascade: the offset asks for a small heading towards the line, the heading error for a rate of turn. A slow integral
/// of curvature takes up what unequal wheels do in proportion to the speed. Well damped from 0.2 to 3.5 m/s.
class LineTracking {
 public:
  LineTracking(const RunConfig& config, const MotionLimits& limits, double heading_rad);

  /// Rate of turn to order, bounded. `to_release_s`: before the release the offset is let be and the heading comes
  /// first.
  double step(double lateral_m, double heading_rad, double speed_mps, double to_release_s, Duration dt);

 private:
  double wanted_heading_rad(double lateral_m, double to_release_s) const;

  RunConfig config_;
  MotionLimits limits_;
  double heading_rad_;
  double curvature_per_m_ = 0.0;
  double ordered_radps_ = 0.0;
};

}  // namespace hogline::servo
