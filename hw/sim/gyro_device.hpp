// The simulated fibre-optic gyro, written from the KVH DSP-3000's description (maker's manual 54-0215).
#pragma once

#include <cstdint>
#include <deque>
#include <random>
#include <string>
#include <string_view>

#include "hw/sim/scenario.hpp"
#include "vision/percepts/stamp.hpp"

namespace hogline::hw::sim {

/// Text: "ddd.dddddd b\r\n", the rate in deg/s (or an angle in deg) and 1 for valid, 0 for a fault. Binary: words of
/// four bytes. The letters R, A, P and Z choose what is sent and set the integrated angle to zero. Moves only with
/// step().
class GyroDevice {
 public:
  enum class Mode { rate, incremental_angle, integrated_angle };

  GyroDevice(const GyroScenario& scenario, std::uint64_t seed, Stamp start);

  /// Measures up to `now`; the true rate, against the ice, is taken to have changed evenly since the last step.
  void step(Stamp now, double true_rate_radps);
  /// The bytes that have arrived by the last step and were not read before.
  std::string read();
  /// What the program sends.
  void write(std::string_view bytes);

  // Fault injection.
  void set_silent(bool silent) { silent_ = silent; }                        ///< no more readings
  void set_valid(bool valid) { valid_ = valid; }                            ///< the device's own flag
  void add_bias(double bias_radps) { scenario_.bias_radps += bias_radps; }  ///< a step
  void set_stuck(bool stuck) { stuck_ = stuck; }                            ///< the last reading again and again
  void set_garbled(bool garbled) { garbled_ = garbled; }                    ///< bits of each reading are flipped
  void set_held(bool held) { held_ = held; }  ///< nothing arrives; when it ends all of it does at once
  /// As after a loss of power, or another program's doing. A deaf one does not hear any letter.
  void set_mode(Mode mode) { mode_ = mode; }
  void set_deaf(bool deaf) { deaf_ = deaf; }

 private:
  struct Reading {
    Stamp arrival{};
    std::string bytes;
  };
  void measure(Stamp when, double rate_radps);
  std::string encode(double rate_degps);

  GyroScenario scenario_;
  std::mt19937_64 random_;
  std::normal_distribution<double> unit_normal_;
  Duration period_;
  Stamp now_;
  Stamp next_;
  double rate_radps_ = 0.0;
  double integrated_deg_ = 0.0;
  double last_degps_ = 0.0;
  Mode mode_ = Mode::rate;
  bool silent_ = false;
  bool valid_ = true;
  bool stuck_ = false;
  bool garbled_ = false;
  bool held_ = false;
  bool deaf_ = false;
  std::deque<Reading> readings_;
};

}  // namespace hogline::hw::sim
