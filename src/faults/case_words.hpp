// The words in which the table's rows are written. The table itself fills in the group.
#pragma once

#include <utility>

#include "src/faults/fault_case.hpp"

namespace hogline::faults {

/// A fault at full speed after which the robot stops with the stone held.
inline Case stops(const char* name, const char* injected, Duration deadline, std::string says, Action inject,
                  Action heal = {}) {
  return {.name = name,
          .injected = injected,
          .deadline = deadline,
          .says = std::move(says),
          .inject = std::move(inject),
          .heal = std::move(heal)};
}

/// A fault at full speed that is survived: it lasts so long, or until the end where that is zero.
inline Case goes_on(const char* name, const char* injected, Duration lasts, Action inject, Action heal = {}) {
  return {.name = name,
          .injected = injected,
          .expect = Expect::goes_on,
          .says = {},
          .inject = std::move(inject),
          .heal = std::move(heal),
          .lasts = lasts};
}

/// The same at another time.
inline Case with(Case c, Strike strike) {
  c.strike = strike;
  return c;
}

/// The same at another time, with another end.
inline Case with(Case c, Strike strike, Expect expect) {
  c.expect = expect;
  return with(std::move(c), strike);
}

/// The same, which does not end as it should, and why.
inline Case short_of(Case c, const char* why) {
  c.shortcoming = why;
  return c;
}

}  // namespace hogline::faults
