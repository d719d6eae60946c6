// Whether a stream of rates can be a turning robot's. The device has no checksum and no counter.
#pragma once

#include <optional>
#include <string_view>

namespace hogline::hw::dsp3000 {

struct PlausibilityConfig {
  double max_rate_radps = 0.0;   ///< the device measures up to 375 deg/s; beyond 500 it is wrong though marked valid
  double max_slew_radps2 = 0.0;  ///< faster than any bump turns the robot
  int stuck_samples = 0;         ///< so many equal ones in a row are no measurements: its noise is many digits
};

class Plausibility {
 public:
  explicit Plausibility(const PlausibilityConfig& config) : config_(config) {}

  /// Judges the next rate, `period_s` after the last one. Nothing when it is plausible, else why not (a constant).
  /// After a jump the next rate is compared with the one that jumped: a lone bad one costs two samples, a real one one.
  std::optional<std::string_view> judge(double rate_radps, double period_s);
  void restart();

 private:
  PlausibilityConfig config_;
  std::optional<double> last_radps_;
  int equal_ = 0;
};

}  // namespace hogline::hw::dsp3000
