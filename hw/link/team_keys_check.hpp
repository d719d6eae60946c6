// What is asked of make_team_keys, before anything is made.
#pragma once

#include "hw/link/team_keys.hpp"

namespace hogline::hw::link {

/// Throws TeamKeysRefused.
void check_request(const TeamKeysRequest& request);

}  // namespace hogline::hw::link
