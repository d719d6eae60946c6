// The gyro's bias, estimated while the body stands, and watched for steps.
#pragma once

#include <optional>
#include <string_view>

#include "hw/gyro.hpp"

namespace hogline::hw::dsp3000 {

struct RestBiasConfig {
  int window_samples = 0;       ///< a mean over so many readings at rest is one look at the bias
  double max_bias_radps = 0.0;  ///< a larger one is no bias: another mode, or broken
  double max_step_radps = 0.0;  ///< between the estimate and three looks in a row
};

/// The mean of all looks since the start; the sigma is that of their spread, at least what one reading's spread allows.
class RestBias {
 public:
  explicit RestBias(const RestBiasConfig& config) : config_(config) {}

  /// A valid reading. Nothing unless what rest shows is impossible (a constant that says why). Any motion starts the
  /// window anew, after half a window of rest: late readings and a rocking body are over then.
  std::optional<std::string_view> feed(double rate_radps, bool at_rest);
  std::optional<GyroBias> bias() const;
  /// Forgets everything.
  void restart();

 private:
  std::optional<std::string_view> look(double mean_radps);

  RestBiasConfig config_;
  double sum_radps_ = 0.0;
  double sum_of_squares_ = 0.0;
  int resting_ = 0;  ///< readings of rest before the first window
  int samples_ = 0;
  int looks_ = 0;
  double estimate_radps_ = 0.0;
  double window_variance_ = 0.0;  ///< of a window's mean, from the spread inside it
  int departed_ = 0;              ///< looks in a row that are far from the estimate
};

}  // namespace hogline::hw::dsp3000
