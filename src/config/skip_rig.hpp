// The part of the rig file that the skip needs: its head, its two cameras on it, and what it relies on.
#pragma once

#include <string>
#include <string_view>

#include "hw/canopen/head_config.hpp"
#include "servo/skip_config.hpp"
#include "src/config/rig.hpp"

namespace hogline::config {

struct SkipRig {
  Rig rig;  ///< with near and far camera
  hw::TwoAxisHeadConfig head;
  servo::SkipConfig skip;
  double far_mount_sigma_rad = 0.0;  ///< of the far camera's axes against the near one's
};

/// Reads and checks a rig file with every section that the skip needs. Throws ConfigError.
SkipRig load_skip_rig(const std::string& path);

/// The same from text; `name` stands in messages.
SkipRig parse_skip_rig(std::string_view text, const std::string& name);

}  // namespace hogline::config
