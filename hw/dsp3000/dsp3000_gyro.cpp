#include "hw/dsp3000/dsp3000_gyro.hpp"

#include <cmath>
#include <utility>

namespace hogline::hw {

Dsp3000Gyro::Dsp3000Gyro(ByteSource source, const Dsp3000Config& config)
    : source_(std::move(source)), config_(config) {}

void Dsp3000Gyro::step(Stamp now) {
  if (!last_news_) last_news_ = now;
  if (const auto measurement = lines_.feed(source_())) {
    last_news_ = now;
    state_.rate_radps = config_.sign * measurement->rate_radps;
    state_.valid = measurement->valid && std::abs(measurement->rate_radps) <= config_.max_rate_radps;
    state_.stamp = now - config_.latency;
  }
  if (now - *last_news_ <= config_.silence_limit) return;
  state_.valid = false;
  if (!state_.error) state_.error = DeviceError{DeviceErrorKind::timeout, "gyro", "no measurement arrives", now};
}

void Dsp3000Gyro::rearm() {
  state_.error.reset();
  last_news_.reset();
}

}  // namespace hogline::hw
