#include "hw/dsp3000/rest_bias.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hogline::hw::dsp3000 {

namespace {

constexpr int steps_after = 3;   // a bump spoils one look, or two where it falls between them
constexpr int most_looks = 120;  // the estimate follows a drift over this many looks

}  // namespace

std::optional<std::string_view> RestBias::feed(double rate_radps, bool at_rest) {
  if (!at_rest) {
    resting_ = samples_ = 0;
    sum_radps_ = sum_of_squares_ = 0.0;
    return std::nullopt;
  }
  if (resting_ < config_.window_samples / 2) {
    ++resting_;
    return std::nullopt;
  }
  sum_radps_ += rate_radps;
  sum_of_squares_ += rate_radps * rate_radps;
  if (++samples_ < config_.window_samples) return std::nullopt;
  const double count = samples_;
  const double mean = sum_radps_ / count;
  window_variance_ = std::max(sum_of_squares_ / count - mean * mean, 0.0) / count;
  samples_ = 0;
  sum_radps_ = sum_of_squares_ = 0.0;
  return look(mean);
}

std::optional<std::string_view> RestBias::look(double mean_radps) {
  const bool too_large = std::abs(mean_radps) > config_.max_bias_radps;
  const bool stepped = looks_ > 0 && std::abs(mean_radps - estimate_radps_) > config_.max_step_radps;
  departed_ = too_large || stepped ? departed_ + 1 : 0;
  if (departed_ >= steps_after) return too_large ? "it shows a turn while the body stands" : "its bias has stepped";
  if (departed_ > 0) return std::nullopt;
  looks_ = std::min(looks_ + 1, most_looks);
  estimate_radps_ += (mean_radps - estimate_radps_) / looks_;
  return std::nullopt;
}

std::optional<GyroBias> RestBias::bias() const {
  if (looks_ == 0) return std::nullopt;
  return GyroBias{.radps = estimate_radps_, .sigma_radps = std::sqrt(window_variance_ / looks_)};
}

void RestBias::restart() { *this = RestBias(config_); }

}  // namespace hogline::hw::dsp3000
