// Heading of the body in e and the gyro's bias: the gyro carries it from look to look, sheet yaws correct it.
#pragma once

#include "servo/delayed_fusion.hpp"
#include "servo/thrower_config.hpp"

namespace hogline::servo {

struct HeadingEstimate {
  double yaw_rad = 0.0;  ///< of b in e, counter-clockwise positive
  double yaw_sigma_rad = 0.0;
  double rate_radps = 0.0;  ///< the gyro's last rate less its bias
  double bias_radps = 0.0;
  double bias_sigma_radps = 0.0;
};

/// Two-state Kalman filter (yaw, gyro bias), linear. At rest the gyro's reading is its bias.
class HeadingModel {
 public:
  struct State {
    double yaw_rad = 0.0;
    double bias_radps = 0.0;
    double rate_radps = 0.0;  ///< raw, in force since the last input
    bool at_rest = true;
    double yaw_yaw = 0.0;  ///< covariance
    double yaw_bias = 0.0;
    double bias_bias = 0.0;
  };
  struct Input {
    double rate_radps = 0.0;
    bool at_rest = false;
  };
  struct Measurement {
    double yaw_rad = 0.0;
    double sigma_rad = 0.0;
    double counts_as = 1.0;  ///< of how many independent looks; the gate takes it for one
  };

  explicit HeadingModel(const GyroConfig& config) : config_(config) {}
  void hold(State& state, double dt_s) const;
  void drive(State& state, double dt_s, const Input& input) const;
  bool correct(State& state, const Measurement& measurement) const;

 private:
  void propagate(State& state, double dt_s, double rate_radps, bool at_rest) const;
  GyroConfig config_;
};

class HeadingFilter {
 public:
  HeadingFilter(const GyroConfig& config, Stamp start);

  /// A gyro sample, raw. `at_rest`: the body is known to stand during the time up to it.
  void gyro(Stamp stamp, double rate_radps, bool at_rest);

  /// Sets the heading, e.g. from a robust measurement at rest; keeps what is known of the bias.
  void start(Stamp stamp, double yaw_rad, double sigma_rad);
  bool started() const { return started_; }

  /// A yaw seen at `stamp` (middle of exposure), however late. `counts_as`: looks that share an error of n looks'
  /// length count as one n-th of an independent look each. Precondition: started, sigma_rad > 0, 0 < counts_as <= 1,
  /// all finite.
  Fusion sheet_yaw(Stamp stamp, double yaw_rad, double sigma_rad, double counts_as = 1.0);

  HeadingEstimate at(Stamp stamp) const;
  int gated_in_a_row() const { return gated_in_a_row_; }
  int gated() const { return gated_; }

 private:
  DelayedFusion<HeadingModel> fusion_;
  bool started_ = false;
  int gated_in_a_row_ = 0;
  int gated_ = 0;
};

}  // namespace hogline::servo
