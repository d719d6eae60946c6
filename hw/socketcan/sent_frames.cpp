#include "hw/socketcan/sent_frames.hpp"

#include <algorithm>

namespace hogline::hw {

bool SentFrames::add(const CanFrame& frame, Stamp now) {
  const bool room = count_ < capacity;
  if (!room) erase(0);
  frames_[count_++] = {frame, now};
  return room;
}

bool SentFrames::confirm(const CanFrame& frame) {
  for (std::size_t i = 0; i < count_; ++i) {
    if (frames_[i].frame == frame) {
      erase(i);
      return true;
    }
  }
  return false;
}

bool SentFrames::holds(const CanFrame& like) const {
  return std::any_of(frames_.begin(), frames_.begin() + count_, [&like](const StampedCanFrame& sent) {
    return sent.frame.id == like.id && sent.frame.extended == like.extended;
  });
}

std::uint64_t SentFrames::expire(Stamp limit) {
  std::uint64_t expired = 0;
  for (; count_ > 0 && frames_[0].stamp < limit; ++expired) erase(0);
  return expired;
}

std::optional<Stamp> SentFrames::oldest() const { return count_ > 0 ? std::optional(frames_[0].stamp) : std::nullopt; }

void SentFrames::erase(std::size_t position) {
  std::move(frames_.begin() + position + 1, frames_.begin() + count_, frames_.begin() + position);
  --count_;
}

}  // namespace hogline::hw
