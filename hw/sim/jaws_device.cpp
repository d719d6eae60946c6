#include "hw/sim/jaws_device.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::hw::sim {

namespace {

constexpr int illegal_address = 2;
constexpr double grip_position = 189.0;  // 0xBD, as in the maker's example of a gripped object
constexpr double closed_position = 255.0;
constexpr double freeing_travel = 20.0;  // counts of opening until the stone is free

}  // namespace

JawsDevice::JawsDevice(const GripperScenario& scenario, std::uint64_t seed, Stamp start)
    : scenario_(scenario), random_(seed), now_(start), motion_start_(start), activation_end_(start) {
  if (!scenario.holds_stone_at_start) return;
  stone_ = true;
  activation_ = Activation::active;
  go_to_ = true;
  requested_ = 255;
  object_ = Object::contact_closing;
  position_ = from_ = target_ = grip_position;
}

int JawsDevice::write(int address, std::span<const std::uint16_t> values) {
  if (address != holding_start || values.size() != 3) return illegal_address;
  const unsigned action = values[0] >> 8U;
  const bool activate = (action & 0x01U) != 0;
  if (!activate) {
    activation_ = Activation::reset;
    return 0;
  }
  if (activation_ == Activation::reset) start_activation();
  go_to_ = (action & 0x08U) != 0;
  if (go_to_ && activation_ == Activation::active) go_to(static_cast<std::uint8_t>(values[1] & 0xFFU));
  if (!go_to_) requested_ = static_cast<std::uint8_t>(values[1] & 0xFFU);
  return 0;
}

// The fingers run through their whole stroke: a stone between them is dropped.
void JawsDevice::start_activation() {
  activation_ = Activation::activating;
  activation_end_ = now_ + from_seconds(scenario_.activation_time_s);
  if (stone_) free_at_ = now_;
}

void JawsDevice::go_to(std::uint8_t position) {
  if (jammed_) {
    requested_ = position;
    return;
  }
  if (position == requested_ && (in_motion_ || object_ != Object::at_position || position_ == position)) return;
  requested_ = position;
  from_ = position_;
  target_ = position;
  in_motion_ = true;
  motion_start_ = now_ + from_seconds(scenario_.motion_delay_s);
  rate_per_s_ = closed_position / scenario_.full_stroke_time_s;
  catches_ = closing() && (stone_ || between_);
  if (closing()) free_at_.reset();
  if (closing() || !stone_) return;
  std::normal_distribution<double> jitter(scenario_.opening_delay_s, scenario_.opening_jitter_s);
  const double delay_s = std::max(jitter(random_), scenario_.motion_delay_s + 1e-3);
  rate_per_s_ = freeing_travel / (delay_s - scenario_.motion_delay_s);
  free_at_ = now_ + from_seconds(delay_s);
}

void JawsDevice::step(Stamp now) {
  now_ = now;
  if (activation_ == Activation::activating && now_ >= activation_end_) {
    activation_ = Activation::active;
    position_ = from_ = target_ = 0.0;
    requested_ = 0;
    object_ = Object::at_position;
  }
  if (free_at_ && now_ >= *free_at_) stone_ = false;
  if (jammed_) {
    in_motion_ = false;
    if (stone_) free_at_.reset();
  }
  if (!in_motion_ || now_ < motion_start_) return;

  object_ = Object::moving;
  const double travelled = rate_per_s_ * seconds(now_ - motion_start_);
  const double stop = catches_ && closing() ? std::min(target_, grip_position) : target_;
  position_ = closing() ? std::min(from_ + travelled, stop) : std::max(from_ - travelled, stop);
  if (position_ == stop) finish_motion();
}

void JawsDevice::finish_motion() {
  in_motion_ = false;
  stone_ = stone_ || (closing() && catches_);
  object_ = closing() && stone_ ? Object::contact_closing : Object::at_position;
}

void JawsDevice::lose_stone() {
  if (!stone_) return;
  stone_ = false;
  catches_ = false;
  free_at_ = now_;
  from_ = position_;
  target_ = closed_position;
  rate_per_s_ = closed_position / scenario_.full_stroke_time_s;
  motion_start_ = now_;
  in_motion_ = true;
}

// A spindle that no longer locks itself: what was requested stays requested.
void JawsDevice::give_way() {
  if (!stone_) return;
  catches_ = false;
  from_ = position_;
  target_ = 0.0;
  rate_per_s_ = closed_position / scenario_.full_stroke_time_s;
  motion_start_ = now_;
  in_motion_ = true;
  free_at_ = now_ + from_seconds(freeing_travel / rate_per_s_);
}

void JawsDevice::cut_power() {
  activation_ = Activation::reset;
  go_to_ = false;
  in_motion_ = false;
}

std::array<std::uint16_t, 3> JawsDevice::inputs() const {
  const unsigned bits = (activation_ == Activation::reset ? 0U : 0x01U) | (go_to_ ? 0x08U : 0U) |
                        static_cast<unsigned>(activation_) << 4U | static_cast<unsigned>(object_) << 6U;
  const unsigned current = object_ == Object::contact_closing ? 0x10U : 0U;
  const auto position = static_cast<unsigned>(std::lround(position_));
  return {static_cast<std::uint16_t>(bits << 8U), static_cast<std::uint16_t>(fault_ << 8U | requested_),
          static_cast<std::uint16_t>(position << 8U | current)};
}

}  // namespace hogline::hw::sim
