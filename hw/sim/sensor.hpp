// The sensor: linear light in, 8-bit bytes in the camera's response curve out, with shot and read noise.
#pragma once

#include <cstdint>
#include <vector>

#include "hw/sim/appearance.hpp"

namespace hogline::hw::sim {

/// Works on the square root of the electrons, where the noise is the same everywhere (Anscombe 1948): one table of
/// standard normal numbers serves every pixel, and one look-up gives its byte.
class Sensor {
 public:
  /// The table of noise is drawn from `seed`. Precondition: gamma and full_scale_electrons are positive.
  Sensor(const SensorModel& model, std::uint64_t seed, int width_px);

  /// One row. `red`, `green`, `blue` are linear light, 0 or more, `width_px` long; `bgr` takes 3 * width_px bytes. The
  /// noise depends on `frame_seed` and `row` alone. `scratch` is reused memory.
  void expose(const float* red, const float* green, const float* blue, std::uint64_t frame_seed, int row,
              std::uint8_t* bgr, std::vector<std::int32_t>& scratch) const;

  /// The byte of a level of light without noise.
  std::uint8_t byte_of(double light) const;

 private:
  SensorModel model_;
  int width_px_;
  float electrons_;      ///< of full scale
  float read_variance_;  ///< in electrons^2
  float noise_at_zero_;  ///< of the root, in steps of the table
  float noise_growth_;   ///< with the root: from the pebble
  float scale_;          ///< from the root to steps of the table
  int margin_ = 0;       ///< of the table, below and above: how far the noise reaches
  std::vector<std::uint8_t> bytes_;
  std::vector<float> noise_;
};

}  // namespace hogline::hw::sim
