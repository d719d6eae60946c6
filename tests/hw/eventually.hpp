// Waiting for what threads and other programs do.
#pragma once

#include <chrono>
#include <thread>

namespace hogline::hw {

/// Asks until the condition holds; false when it did not within `patience`. What comes true is not waited for longer
/// than it takes, so the patience may be long.
template <typename Condition>
bool comes_true(Condition condition, std::chrono::nanoseconds patience = std::chrono::seconds(60)) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace hogline::hw
