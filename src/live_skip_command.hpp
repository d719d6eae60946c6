// `hogline skip --live`: the skip as a program that stays.
#pragma once

#include <string>

namespace hogline {

struct LiveSkipOptions {
  std::string rig;
};

/// Runs until it is told to end (SIGTERM, SIGINT, or `quit` on stdin). Lines on stdin: `begin` looks at the house and
/// waits for a stone; `order SPEED_MPS HEADING_DEG SPIN_RADPS` orders a shot. Throws ConfigError for wrong use.
int run_live_skip(const LiveSkipOptions& options);

}  // namespace hogline
