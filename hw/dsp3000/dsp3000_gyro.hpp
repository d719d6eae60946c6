// Adapter: a KVH DSP-3000 in rate mode behind a stream of bytes.
#pragma once

#include <functional>
#include <string>

#include "hw/dsp3000/dsp3000_lines.hpp"
#include "hw/gyro.hpp"

namespace hogline::hw {

struct Dsp3000Config {
  double sign = 0.0;            ///< +1 or -1: makes counter-clockwise from above positive, whatever way it is mounted
  Duration latency{};           ///< from the measured moment to the line's arrival: taken off the stamp
  Duration silence_limit{};     ///< the longest time without a measurement
  double max_rate_radps = 0.0;  ///< beyond it a measurement is implausible (the device's range is 375 deg/s)
};

/// A measurement that the device marks as faulty, or beyond max_rate_radps, is given as not valid. Silence is latched.
class Dsp3000Gyro final : public Gyro {
 public:
  /// Gives the bytes that have arrived and were not read before. Does not block.
  using ByteSource = std::function<std::string()>;
  Dsp3000Gyro(ByteSource source, const Dsp3000Config& config);

  void step(Stamp now) override;
  GyroState state() const override { return state_; }
  void rearm();
  std::uint64_t garbled() const { return lines_.garbled(); }

 private:
  ByteSource source_;
  Dsp3000Config config_;
  dsp3000::LineReader lines_;
  GyroState state_;
  std::optional<Stamp> last_news_;  ///< or the first step
};

}  // namespace hogline::hw
