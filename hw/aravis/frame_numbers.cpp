#include "hw/aravis/frame_numbers.hpp"

namespace hogline::hw {
namespace {

constexpr std::uint64_t narrow_numbers = 65535;  // 1 .. 65535

}  // namespace

FrameNumbers::Step FrameNumbers::next(std::uint64_t counter) {
  if (counter > narrow_numbers) wide_ = true;
  Step step;
  if (!started_) {
    number_ = ever_ ? number_ + 1 : counter;
  } else {
    std::uint64_t forward = counter - last_counter_;
    if (counter <= last_counter_) {
      // Half the circle decides whether a narrow counter has wrapped or gone back.
      const std::uint64_t wrapped = narrow_numbers - last_counter_ + counter;
      const bool plausible = !wide_ && counter != last_counter_ && wrapped <= narrow_numbers / 2;
      step.backward = !plausible;
      forward = plausible ? wrapped : 1;
    }
    step.lost = forward - 1;
    number_ += forward;
  }
  started_ = ever_ = true;
  last_counter_ = counter;
  step.number = number_;
  return step;
}

}  // namespace hogline::hw
