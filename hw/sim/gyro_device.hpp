// The simulated fibre-optic gyro, written from the KVH DSP-3000's description: one line of text for each measurement.
#pragma once

#include <cstdint>
#include <deque>
#include <random>
#include <string>

#include "hw/sim/scenario.hpp"
#include "vision/percepts/stamp.hpp"

namespace hogline::hw::sim {

/// Rate mode, ASCII: "ddd.dddddd b\r\n", the rate in deg/s and 1 for valid, 0 for a fault. Moves only with step().
class GyroDevice {
 public:
  GyroDevice(const GyroScenario& scenario, std::uint64_t seed, Stamp start);

  /// Measures up to `now`; the true rate is taken to have changed evenly since the last step.
  void step(Stamp now, double true_rate_radps);
  /// The bytes that have arrived by the last step and were not read before.
  std::string read();

  void set_silent(bool silent) { silent_ = silent; }                        ///< fault injection: no more lines
  void set_valid(bool valid) { valid_ = valid; }                            ///< fault injection: the device's own flag
  void add_bias(double bias_radps) { scenario_.bias_radps += bias_radps; }  ///< fault injection: a step

 private:
  struct Line {
    Stamp arrival{};
    std::string text;
  };
  void measure(Stamp when, double rate_radps);

  GyroScenario scenario_;
  std::mt19937_64 random_;
  std::normal_distribution<double> unit_normal_;
  Duration period_;
  Stamp now_;
  Stamp next_;
  double rate_radps_ = 0.0;
  bool silent_ = false;
  bool valid_ = true;
  std::deque<Line> lines_;
};

}  // namespace hogline::hw::sim
