// An error of the near view's yaw that depends on the yaw it says: measured by turning on the spot, and taken off.
#pragma once

#include <string>
#include <vector>

#include "vision/percepts/sheet_pose.hpp"

namespace hogline::servo {

struct YawBiasKnot {
  double estimate_rad = 0.0;  ///< the yaw as seen
  double bias_rad = 0.0;      ///< seen less true
};

/// Knots in the order of their estimates, straight lines between them, the end knots' bias beyond them. No knots: no
/// bias is known.
using YawBiasTable = std::vector<YawBiasKnot>;

double yaw_bias(const YawBiasTable& table, double estimate_rad);

/// The percept with the bias of its yaw taken off; as it is when not ok.
SheetPosePercept without_yaw_bias(SheetPosePercept percept, const YawBiasTable& table);

/// One look of the turn on the spot, and the gyro's angle at that moment (integrated from anywhere).
struct TurnSample {
  double time_s = 0.0;
  double estimate_rad = 0.0;
  double gyro_rad = 0.0;
};

struct YawBiasCalibration {
  bool ok = false;
  std::string reason;
  YawBiasTable table;
  double gyro_bias_radps = 0.0;  ///< that was left in the angles
  double residual_rad = 0.0;     ///< RMS of the samples about the table
  double largest_rad = 0.0;      ///< of the biases, against that at the reference
};

/// The paper's figure 8(a): increments of the estimate less increments of the gyro, as a function of the estimate.
/// Least squares for the knots, evenly spaced over the samples, and the gyro's remaining bias. A gyro only knows
/// differences, so the bias at one reference estimate must be given: figure 8(b), reference_bias(). The turn must go
/// there and back, or bias of the gyro and slope of the table could not be told apart.
YawBiasCalibration calibrate_yaw_bias(const std::vector<TurnSample>& samples, int knots, double reference_estimate_rad,
                                      double reference_bias_rad);

/// Figure 8(b): a body that was aligned by the estimate and then ran straight ended this far left of the centre line
/// after this way, by whatever rule one trusts. Seen less true.
double reference_bias_rad(double left_of_line_m, double way_m);

}  // namespace hogline::servo
