#include "hw/canopen/set_point_handshake.hpp"

#include <utility>

namespace hogline::hw {

void SetPointHandshake::restart() {
  phase_ = Phase::idle;
  requested_.reset();
}

void SetPointHandshake::enter(Phase phase, Stamp now) {
  phase_ = phase;
  since_ = now;
  if (phase == Phase::offered) target_ = std::exchange(requested_, std::nullopt).value_or(target_);
}

std::uint16_t SetPointHandshake::step(std::uint16_t statusword, Stamp now) {
  const bool acknowledged = (statusword & set_point_acknowledge_bit) != 0;
  switch (phase_) {
    case Phase::idle:
      if (requested_) enter(Phase::offered, now);
      break;
    case Phase::offered:
      if (!acknowledged) enter(Phase::raised, now);
      break;
    case Phase::raised:
      if (acknowledged) enter(Phase::lowered, now);
      break;
    case Phase::lowered:
      if (!acknowledged) enter(requested_ ? Phase::offered : Phase::idle, now);
      break;
  }
  return phase_ == Phase::raised ? new_set_point_bit | change_immediately_bit : 0;
}

}  // namespace hogline::hw
