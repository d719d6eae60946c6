// Time as the comparison measures it: the processor time of the whole process. Other programs on the machine disturb it
// least, and a method that used a second thread would pay for it.
#pragma once

#include <ctime>

namespace hogline::bench {

inline double processor_time_s() {
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace hogline::bench
