// Frame numbers that only ever grow, from a camera's counter that wraps.
#pragma once

#include <cstdint>

namespace hogline::hw {

/// GigE Vision 1.x counts in 16 bits and skips 0: 65535 is followed by 1. Others count in 32 or 64 bits; a camera is
/// taken for one of these from its first number beyond 65535 on.
class FrameNumbers {
 public:
  struct Step {
    std::uint64_t number = 0;  ///< grows by at least 1; starts at the camera's first number
    std::uint64_t lost = 0;    ///< frames between the last one and this
    bool backward = false;     ///< the camera's counter went back or stood still: started anew, or a repeated frame
  };
  /// Of the next buffer in the order of arrival.
  Step next(std::uint64_t counter);
  /// The camera was started anew: its counter may begin anywhere, the numbers go on growing.
  void restart() { started_ = false; }

 private:
  std::uint64_t last_counter_ = 0;
  std::uint64_t number_ = 0;
  bool started_ = false;
  bool ever_ = false;
  bool wide_ = false;
};

}  // namespace hogline::hw
