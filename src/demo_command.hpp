// `hogline demo`: the same throw, told to a person.
#pragma once

#include "src/throw_command.hpp"

namespace hogline {

/// Runs the throw and prints a readable summary. Throws ConfigError for wrong use.
int run_demo(const ThrowOptions& options);

}  // namespace hogline
