// `hogline link`: joins a rig's link as its robot and says who is there; sends nothing but heartbeats.
#pragma once

#include <string>

namespace hogline {

struct LinkOptions {
  std::string rig;
  double seconds = 10.0;
  bool json = false;
};

/// 0: all peers are there at the end, 1: one is not. SIGINT and SIGTERM end it early, with what was heard until then.
/// Throws ConfigError for wrong use.
int run_link(const LinkOptions& options);

}  // namespace hogline
