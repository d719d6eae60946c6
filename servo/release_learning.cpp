#include "servo/release_learning.hpp"

#include <cmath>
#include <sstream>

namespace hogline::servo {
namespace {

constexpr double delay_drift_s = 0.0005;  // a throw
constexpr double drag_drift_mps = 0.0003;
constexpr double gate_sigmas = 5.0;
// Of a travel that is reported in whole counts, 2 to 3 ms each, and polled: what interpolation leaves.
constexpr double reading_sigma_s = 0.001;

/// Scalar measurement of one of the two numbers.
std::string correct(ReleaseKnowledge& k, std::size_t i, double measured, double sigma, const char* name) {
  auto& p = k.covariance;
  double& value = i == 0 ? k.delay_s : k.drag_mps;
  const double innovation = measured - value;
  const double variance = p[3 * i] + sigma * sigma;
  if (!(std::isfinite(measured) && std::isfinite(sigma) && sigma > 0.0)) return std::string(name) + ": not a number";
  if (innovation * innovation > gate_sigmas * gate_sigmas * variance) {
    std::ostringstream text;
    text << name << ": " << measured << " is too far from " << value;
    return text.str();
  }
  const std::size_t other = 1 - i;
  const double cross = p[2 * other + i];
  const double gain = p[3 * i] / variance;
  const double cross_gain = cross / variance;
  value += gain * innovation;
  (i == 0 ? k.drag_mps : k.delay_s) += cross_gain * innovation;
  p[3 * other] -= cross_gain * cross;
  p[1] = p[2] = cross - gain * cross;
  p[3 * i] -= gain * p[3 * i];
  return {};
}

}  // namespace

ReleaseKnowledge prior_of(const ReleaseConfig& config) {
  return {.delay_s = config.gripper_delay_s,
          .drag_mps = config.drag_mps,
          .covariance = {config.gripper_delay_sigma_s * config.gripper_delay_sigma_s, 0.0, 0.0,
                         config.drag_sigma_mps * config.drag_sigma_mps},
          .throws = 0};
}

ReleaseLesson learn(const ReleaseKnowledge& knowledge, const ReleaseFeedback& feedback) {
  ReleaseLesson lesson{.knowledge = knowledge, .refused = {}};
  ReleaseKnowledge& k = lesson.knowledge;
  k.covariance[0] += delay_drift_s * delay_drift_s;
  k.covariance[3] += drag_drift_mps * drag_drift_mps;
  if (feedback.delay_s) lesson.refused = correct(k, 0, *feedback.delay_s, feedback.delay_sigma_s, "delay");
  if (feedback.drag_mps) {
    const std::string refused = correct(k, 1, *feedback.drag_mps, feedback.drag_sigma_mps, "drag");
    lesson.refused += (lesson.refused.empty() || refused.empty() ? "" : "; ") + refused;
  }
  if (lesson.refused.empty() && (feedback.delay_s || feedback.drag_mps)) ++k.throws;
  return lesson;
}

ReleaseLesson learn_rehearsed(const ReleaseKnowledge& knowledge, const std::vector<double>& delays_s, double jitter_s) {
  ReleaseLesson lesson{.knowledge = knowledge, .refused = {}};
  for (const double delay_s : delays_s) {
    lesson.refused = correct(lesson.knowledge, 0, delay_s, std::hypot(jitter_s, reading_sigma_s), "delay");
    if (!lesson.refused.empty()) return {.knowledge = knowledge, .refused = lesson.refused};
  }
  return lesson;
}

ReleaseConfig with_knowledge(ReleaseConfig config, const ReleaseKnowledge& knowledge) {
  config.gripper_delay_s = knowledge.delay_s;
  config.gripper_delay_sigma_s = std::sqrt(knowledge.covariance[0]);
  config.drag_mps = knowledge.drag_mps;
  config.drag_sigma_mps = std::sqrt(knowledge.covariance[3]);
  return config;
}

}  // namespace hogline::servo
