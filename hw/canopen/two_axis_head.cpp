#include "hw/canopen/two_axis_head.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <vector>

namespace hogline::hw {
namespace {

const TwoAxisHeadConfig& checked(const TwoAxisHeadConfig& config) {
  if (const auto error = config_error(config)) throw std::invalid_argument("head: " + *error);
  return config;
}

AxisPairConfig pair_config(const TwoAxisHeadConfig& config) {
  const double ramp_s = std::max(config.pan.max_speed_radps / config.pan.quick_stop_radps2,
                                 config.tilt.max_speed_radps / config.tilt.quick_stop_radps2);
  return {.name = "head",
          .master_node = config.master_node,
          .timing = config.timing,
          .duties = config.duties,
          .stop_deadline = from_seconds(ramp_s) + config.timing.stop_margin};
}

}  // namespace

TwoAxisHead::TwoAxisHead(CanBus& bus, const TwoAxisHeadConfig& config)
    : config_(checked(config)),
      axes_{HeadAxis{config_.pan, config_}, HeadAxis{config_.tilt, config_}},
      pair_(bus, pair_config(config_), {&axes_[0], &axes_[1]}) {}

void TwoAxisHead::step(Stamp now) {
  pair_.listen(now);
  follow_rates(now);
  pair_.advance(now);
  send(now);
}

void TwoAxisHead::point(const PanTilt& target, Stamp now) {
  if (!axes_[0].within_limits(target.pan_rad) || !axes_[1].within_limits(target.tilt_rad)) {
    return refuse("target is not finite or beyond the limits [rad]", target.pan_rad, target.tilt_rad, now);
  }
  if (!pair_.takes_commands()) return;
  tracking_.reset();
  axes_[0].point(target.pan_rad, now);
  axes_[1].point(target.tilt_rad, now);
}

void TwoAxisHead::track(const PanTiltRate& rates, Stamp now) {
  if (!axes_[0].within_speed(rates.pan_radps) || !axes_[1].within_speed(rates.tilt_radps)) {
    return refuse("rate is not finite or too fast [rad/s]", rates.pan_radps, rates.tilt_radps, now);
  }
  if (pair_.takes_commands()) tracking_ = Rates{rates, now};
}

void TwoAxisHead::refuse(const char* what, double pan, double tilt, Stamp now) {
  char text[128];
  std::snprintf(text, sizeof text, "%s: %.3g, %.3g", what, pan, tilt);
  pair_.fail(DeviceErrorKind::implausible, "head", text, now);
}

void TwoAxisHead::stop() {
  tracking_.reset();
  pair_.quick_stop();
}

// Old rates are no rates: the head stands, and stays in cyclic velocity.
void TwoAxisHead::follow_rates(Stamp now) {
  if (!pair_.takes_commands()) return tracking_.reset();
  if (!tracking_) return;
  const bool fresh = now - tracking_->stamp <= config_.timing.command_age_limit;
  const PanTiltRate rates = fresh ? tracking_->rates : PanTiltRate{};
  axes_[0].track(rates.pan_radps, now);
  axes_[1].track(rates.tilt_radps, now);
}

void TwoAxisHead::send(Stamp now) {
  std::vector<CanFrame> commands;
  for (HeadAxis& axis : axes_) {
    const std::vector<CanFrame> frames = axis.command(pair_.goal(), now);
    commands.insert(commands.end(), frames.begin(), frames.end());
  }
  pair_.send(commands, now);
}

HeadState TwoAxisHead::state() const {
  return {.phase = pair_.phase(),
          .stamp = pair_.feedback_stamp(),
          .measured = {axes_[0].angle_rad(), axes_[1].angle_rad()},
          .rate = {axes_[0].rate_radps(), axes_[1].rate_radps()},
          .on_target = axes_[0].on_target() && axes_[1].on_target(),
          .error = pair_.error()};
}

}  // namespace hogline::hw
