// The rig's link to the other robots.
#pragma once

#include "hw/link/link_config.hpp"
#include "src/config/section.hpp"
#include "src/config/strict_yaml.hpp"

namespace hogline::config {

/// Throws ConfigError: a robot that is its own peer, addresses on the loopback interface.
hw::link::LinkConfig read_link(const Section& section, const Document& document);

}  // namespace hogline::config
