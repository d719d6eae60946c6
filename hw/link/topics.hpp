// The topics: their ROS 2 names, types and qualities of service. doc/link.md says why each is what it is.
#pragma once

#include <dds/dds.h>

#include <array>
#include <functional>
#include <optional>
#include <string_view>

#include "hw/team_messages.hpp"

namespace hogline::hw::link {

struct Topic {
  std::string_view name;  ///< DDS's: "rt/hogline/shot_order" is ROS 2's /hogline/shot_order
  const dds_topic_descriptor_t* type;
  bool reliable;
  bool for_late_joiners;  ///< transient local: the last one is told to whoever comes later
  int depth;
  bool heartbeat;  ///< with deadline and liveliness
  std::optional<TeamMessage> (*decode)(const void* sample);
};

/// In the order of TeamMessage's alternatives.
const std::array<Topic, std::variant_size_v<TeamMessage>>& topics();

}  // namespace hogline::hw::link
