#include "servo/safety/turn_agreement.hpp"

#include <cmath>

namespace hogline::servo {

std::optional<std::string> TurnAgreement::judge(double gyro_radps, double wheels_radps, Duration dt) {
  const bool agree = std::abs(gyro_radps - wheels_radps) <= config_.max_yaw_rate_disagreement_radps;
  disagreeing_ = agree ? Duration::zero() : disagreeing_ + dt;
  if (disagreeing_ > config_.disagreement_time) return "gyro and wheels disagree on the rate of turn";
  return std::nullopt;
}

}  // namespace hogline::servo
