// From the command line's words to a throw, and its progress told on stderr. Shared by `throw` and `demo`.
#pragma once

#include "src/throw_command.hpp"
#include "src/throwing/simulated_throw.hpp"

namespace hogline {

/// Reads rig and scenario (the built-in ones where none is named) and checks the order. Throws ConfigError.
ThrowRequest make_request(const ThrowOptions& options);

/// "oracle" or "rendered".
Eyes eyes_of(const std::string& seer);

/// Runs the throw with progress on stderr, and writes its report; wall_time_s is filled in.
ThrowOutcome carry_out(const ThrowOptions& options, const ThrowRequest& request);

}  // namespace hogline
