// The link can not be opened.
#pragma once

#include <stdexcept>

namespace hogline::hw::link {

/// No such interface, no keys, a domain that is taken. Says what to do.
struct LinkError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace hogline::hw::link
