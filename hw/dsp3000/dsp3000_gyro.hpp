// Adapter: a KVH DSP-3000 behind a line of bytes.
#pragma once

#include <string>
#include <variant>

#include "hw/byte_line.hpp"
#include "hw/dsp3000/dsp3000_lines.hpp"
#include "hw/dsp3000/dsp3000_words.hpp"
#include "hw/dsp3000/plausibility.hpp"
#include "hw/dsp3000/rest_bias.hpp"
#include "hw/gyro.hpp"

namespace hogline::hw {

/// Text, about 100 lines a second at 38400 baud; or words, about 1000 a second at 115200. Both within 3 %.
enum class Dsp3000Variant { text, binary };

struct Dsp3000Config {
  Dsp3000Variant variant = Dsp3000Variant::text;
  double sign = 0.0;          ///< +1 or -1: makes counter-clockwise from above positive, whatever way it is mounted
  double latitude_rad = 0.0;  ///< of the hall, north positive: the earth's rate is 15.04 deg/h times its sine
  Duration latency{};         ///< from the measured moment to the reading's arrival: taken off the stamp
  Duration silence_limit{};   ///< the longest time without a good reading
  Duration mode_deadline{};   ///< from opening the line to rate mode verified
  Duration reopen_delay{};    ///< between a line lost, or silent, and the next attempt to open it by its name
  double max_rate_radps = 0.0;
  double max_slew_radps2 = 0.0;
  Duration stuck_limit{};  ///< readings that are equal for so long are no measurements
  Duration rest_window{};  ///< of a look at the bias
  double max_bias_radps = 0.0;
  double max_bias_step_radps = 0.0;
};

/// After every opening it asks for rate mode and believes nothing before two readings agree. A bad reading is given as
/// not valid; without a good one for the silence limit an error is latched, whose kind says what came instead: nothing
/// (timeout), garbage or another mode (protocol), readings marked faulty (device fault), impossible ones (implausible).
class Dsp3000Gyro final : public Gyro {
 public:
  /// The line must outlive the adapter; it is opened by the first step.
  Dsp3000Gyro(ByteLine& line, const Dsp3000Config& config);

  void step(Stamp now) override;
  GyroState state() const override { return state_; }
  void at_rest(bool resting) override { resting_ = resting; }
  void rearm() override;

  bool verified() const { return verified_; }
  std::uint64_t garbled() const;
  /// Over the last second or more; nothing before.
  std::optional<double> readings_per_s() const { return readings_per_s_; }

 private:
  void open(Stamp now);
  void ask(Stamp now);
  void lose_line(Stamp now, DeviceErrorKind kind, const std::string& what);
  void take(const std::vector<dsp3000::Measurement>& batch, Stamp now);
  std::optional<double> judge(const dsp3000::Measurement& measurement);
  void verify(bool good, Stamp now);
  void count(std::size_t readings, Stamp now);
  void check_deadline(Stamp now);
  void latch(DeviceErrorKind kind, const std::string& what, Stamp now);
  void trouble(DeviceErrorKind kind, std::string_view what);

  ByteLine& line_;
  Dsp3000Config config_;
  double period_s_;
  std::variant<dsp3000::LineReader, dsp3000::WordReader> reader_;
  dsp3000::Plausibility plausibility_;
  dsp3000::RestBias rest_bias_;
  GyroState state_;
  bool resting_ = false;

  bool open_ = false;
  bool verified_ = false;
  int to_skip_ = 0;   ///< readings that may still be of the mode before
  int agreeing_ = 0;  ///< good readings in a row since
  Stamp opened_at_{};
  Stamp asked_at_{};
  std::optional<Stamp> retry_at_;
  std::optional<Stamp> waiting_since_;  ///< the last good reading, or what one is waited for since
  Duration patience_{};                 ///< how long it may last
  DeviceErrorKind trouble_kind_ = DeviceErrorKind::timeout;
  std::string trouble_;

  std::optional<Stamp> counting_since_;
  std::size_t counted_ = 0;
  std::optional<double> readings_per_s_;
};

}  // namespace hogline::hw
