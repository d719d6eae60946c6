// What a fuzz target demands. A broken demand ends the program, which the fuzzer takes for a finding.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace hogline::fuzz {

inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", what);
  std::abort();
}

}  // namespace hogline::fuzz
