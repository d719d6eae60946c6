// One reading of a KVH DSP-3000, whatever the variant it came from.
#pragma once

namespace hogline::hw::dsp3000 {

/// What the device sends, chosen by a letter. The text variant does not say which it is.
enum class Mode { rate, incremental_angle, integrated_angle };

struct Measurement {
  double rate_radps = 0.0;  ///< with the device's own sign; meaningless unless the mode is rate
  bool valid = false;       ///< the device's own flag
  Mode mode = Mode::rate;
};

}  // namespace hogline::hw::dsp3000
