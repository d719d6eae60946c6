#include "hw/dsp3000/plausibility.hpp"

#include <cmath>
#include <utility>

namespace hogline::hw::dsp3000 {

std::optional<std::string_view> Plausibility::judge(double rate_radps, double period_s) {
  if (!(std::abs(rate_radps) <= config_.max_rate_radps)) return "the rate is beyond its range";
  const auto last_radps = std::exchange(last_radps_, rate_radps);
  if (!last_radps) return std::nullopt;
  equal_ = rate_radps == *last_radps ? equal_ + 1 : 0;
  if (equal_ >= config_.stuck_samples) return "the rate is stuck at one value";
  if (std::abs(rate_radps - *last_radps) > config_.max_slew_radps2 * period_s) return "the rate jumps";
  return std::nullopt;
}

void Plausibility::restart() {
  last_radps_.reset();
  equal_ = 0;
}

}  // namespace hogline::hw::dsp3000
