// What is shown against the wall clock is tried until it is shown.
#pragma once

#include <cstdio>
#include <string>

#include "vision/percepts/stamp.hpp"

namespace hogline::live_test {

/// Attempts, of which one must succeed. Where none does, each must have met a machine that was late: it has shown
/// nothing of the programs then, neither good nor bad. What may never happen is asserted in each attempt beside this.
class Tries {
 public:
  /// No attempt begins when this time is over; two are made in any case.
  Tries(Stamp begin, Duration limit) : end_(begin + limit) {}

  bool again(Stamp now) const { return !shown_ && (made_ < 2 || now < end_); }
  void shown() { shown_ = true; }
  void given_up(const std::string& why, bool machine_was_late) {
    ++made_;
    unexplained_ = unexplained_ || !machine_was_late;
    std::printf("attempt %d given up%s: %s\n", made_, machine_was_late ? " on a late machine" : "", why.c_str());
  }
  bool has_shown() const { return shown_; }
  /// Shown, or a machine on which it can not be.
  bool fine() const {
    if (!shown_ && !unexplained_) std::printf("NOT SHOWN: the machine was late in each of %d attempts\n", made_);
    return shown_ || !unexplained_;
  }

 private:
  Stamp end_;
  int made_ = 0;
  bool shown_ = false;
  bool unexplained_ = false;
};

}  // namespace hogline::live_test
