#include "hw/dsp3000/dsp3000_gyro.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hogline::hw {

namespace {

constexpr const char* rate_mode = "R";
constexpr int agreeing_readings = 2;
constexpr int readings_of_before = 2;  // under way while the device is asked
constexpr Duration ask_again_after = std::chrono::milliseconds(100);
constexpr Duration counting_time = std::chrono::seconds(1);
constexpr double rate_tolerance = 0.1;  // the device keeps its rate within 3 %
constexpr const char* silent = "no measurement arrives";

double readings_per_s_of(Dsp3000Variant variant) { return variant == Dsp3000Variant::text ? 100.0 : 1000.0; }

double earth_rate_radps(double latitude_rad) {
  constexpr double at_the_pole_radps = 15.04 / 3600.0 * std::numbers::pi / 180.0;
  return at_the_pole_radps * std::sin(latitude_rad);
}

int samples_in(Duration span, double period_s) {
  return std::max(2, static_cast<int>(std::lround(seconds(span) / period_s)));
}

}  // namespace

Dsp3000Gyro::Dsp3000Gyro(ByteLine& line, const Dsp3000Config& config)
    : line_(line),
      config_(config),
      period_s_(1.0 / readings_per_s_of(config.variant)),
      plausibility_({.max_rate_radps = config.max_rate_radps,
                     .max_slew_radps2 = config.max_slew_radps2,
                     .stuck_samples = samples_in(config.stuck_limit, period_s_)}),
      rest_bias_({.window_samples = samples_in(config.rest_window, period_s_),
                  .max_bias_radps = config.max_bias_radps,
                  .max_step_radps = config.max_bias_step_radps}) {
  if (config.variant == Dsp3000Variant::binary) reader_ = dsp3000::WordReader();
}

std::uint64_t Dsp3000Gyro::garbled() const {
  return std::visit([](const auto& reader) { return reader.garbled(); }, reader_);
}

void Dsp3000Gyro::step(Stamp now) {
  if (!waiting_since_) {
    waiting_since_ = now;
    patience_ = verified_ ? config_.silence_limit : config_.mode_deadline;
  }
  if (!open_) open(now);
  if (open_) {
    const auto bytes = line_.read();
    if (!bytes) return lose_line(now, DeviceErrorKind::disconnected, "the line is gone");
    const auto garbled_before = garbled();
    const auto batch = std::visit([&](auto& reader) { return reader.feed(*bytes); }, reader_);
    if (garbled() != garbled_before) trouble(DeviceErrorKind::protocol, "what arrives is garbled");
    take(batch, now);
    if (!verified_ && now - asked_at_ >= ask_again_after) ask(now);
  }
  check_deadline(now);
}

void Dsp3000Gyro::open(Stamp now) {
  if (retry_at_ && now < *retry_at_) return;
  retry_at_ = now + config_.reopen_delay;
  if (const auto why = line_.open()) return trouble(DeviceErrorKind::disconnected, *why);
  open_ = true;
  opened_at_ = now;
  verified_ = false;
  std::visit([](auto& reader) { reader.restart(); }, reader_);
  trouble(DeviceErrorKind::timeout, silent);
  ask(now);
}

void Dsp3000Gyro::ask(Stamp now) {
  asked_at_ = now;
  to_skip_ = readings_of_before;
  agreeing_ = 0;
  plausibility_.restart();
  if (!line_.write(rate_mode)) trouble(DeviceErrorKind::disconnected, "the line takes no bytes");
}

void Dsp3000Gyro::lose_line(Stamp now, DeviceErrorKind kind, const std::string& what) {
  line_.close();
  open_ = verified_ = false;
  state_.valid = false;
  retry_at_ = now + config_.reopen_delay;
  counting_since_.reset();
  latch(kind, what, now);
}

// Readings that came with one step are averaged: at a thousand a second none is lost for the heading. A burst after a
// stall holds old ones: only the newest counts.
void Dsp3000Gyro::take(const std::vector<dsp3000::Measurement>& batch, Stamp now) {
  if (batch.empty()) return;
  double sum_radps = 0.0;
  int good = 0;
  std::optional<double> newest;
  const bool burst = period_s_ * static_cast<double>(batch.size()) > seconds(config_.silence_limit);
  for (const auto& measurement : batch) {
    newest = judge(measurement);
    verify(newest.has_value(), now);
    if (!newest || !verified_) continue;
    if (const auto wrong = rest_bias_.feed(*newest, resting_))
      latch(DeviceErrorKind::implausible, std::string(*wrong), now);
    sum_radps += *newest;
    ++good;
  }
  count(batch.size(), now);
  state_.bias = rest_bias_.bias();
  state_.valid = newest.has_value() && verified_;
  if (!state_.valid) return;
  waiting_since_ = now;
  patience_ = config_.silence_limit;
  trouble(DeviceErrorKind::timeout, silent);
  state_.rate_radps = burst ? *newest : sum_radps / good;
  const double centre_s = burst ? 0.0 : 0.5 * period_s_ * (static_cast<double>(batch.size()) - 1.0);
  state_.stamp = now - config_.latency - from_seconds(centre_s);
}

// The rate against the ice; nothing when the reading is not to be used.
std::optional<double> Dsp3000Gyro::judge(const dsp3000::Measurement& measurement) {
  if (measurement.mode != dsp3000::Mode::rate) {
    trouble(DeviceErrorKind::protocol, "it is not in rate mode");
    return std::nullopt;
  }
  if (!measurement.valid) {
    trouble(DeviceErrorKind::device_fault, "it marks its measurements as faulty");
    return std::nullopt;
  }
  if (const auto why = plausibility_.judge(measurement.rate_radps, period_s_)) {
    trouble(DeviceErrorKind::implausible, *why);
    return std::nullopt;
  }
  return config_.sign * measurement.rate_radps - earth_rate_radps(config_.latitude_rad);
}

void Dsp3000Gyro::verify(bool good, Stamp now) {
  if (verified_) return;
  if (to_skip_ > 0) {
    --to_skip_;
    return;
  }
  agreeing_ = good ? agreeing_ + 1 : 0;
  if (agreeing_ < agreeing_readings) return;
  verified_ = true;
  counting_since_ = now;
  counted_ = 0;
}

void Dsp3000Gyro::count(std::size_t readings, Stamp now) {
  if (!counting_since_) return;
  counted_ += readings;
  const Duration span = now - *counting_since_;
  if (span < counting_time) return;
  readings_per_s_ = static_cast<double>(counted_) / seconds(span);
  counting_since_ = now;
  counted_ = 0;
  if (std::abs(*readings_per_s_ * period_s_ - 1.0) <= rate_tolerance) return;
  latch(DeviceErrorKind::protocol, "too few or too many measurements arrive", now);
}

void Dsp3000Gyro::check_deadline(Stamp now) {
  if (now - *waiting_since_ <= patience_) return;
  state_.valid = false;
  latch(trouble_kind_, trouble_, now);
  // A line that is silent may be another one by now: it is opened anew by its name.
  if (open_ && now - opened_at_ > config_.mode_deadline) lose_line(now, trouble_kind_, trouble_);
}

void Dsp3000Gyro::trouble(DeviceErrorKind kind, std::string_view what) {
  trouble_kind_ = kind;
  trouble_ = what;
}

void Dsp3000Gyro::latch(DeviceErrorKind kind, const std::string& what, Stamp now) {
  if (!state_.error) state_.error = DeviceError{kind, "gyro", what, now};
}

void Dsp3000Gyro::rearm() {
  state_.error.reset();
  rest_bias_.restart();
  waiting_since_.reset();
  // The mode may be what was wrong: it is asked for and verified anew.
  verified_ = false;
  agreeing_ = 0;
  to_skip_ = readings_of_before;
  asked_at_ = Stamp{};
  state_.valid = false;
}

}  // namespace hogline::hw
