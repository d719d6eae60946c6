// What a robot's link needs to know: the rig's `link` section as plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vision/percepts/stamp.hpp"

namespace hogline::hw::link {

/// Files of one robot for DDS Security 1.1 (authentication, access control, encryption), as `hogline keys` makes them.
struct LinkSecurity {
  std::string folder;  ///< with identity_ca.pem, permissions_ca.pem, governance.p7s and, of this robot, NAME.cert.pem,
                       ///< NAME.key.pem, NAME.permissions.p7s
};

struct LinkConfig {
  std::string robot;                     ///< this robot's name, unique in the team
  std::vector<std::string> peers;        ///< the others' names
  std::uint32_t domain = 0;              ///< DDS domain, 0..232; ROS 2's ROS_DOMAIN_ID
  std::string interface = "lo";          ///< the only network interface that is listened on
  std::vector<std::string> addresses;    ///< where peers may be, as there is no multicast; empty: this machine alone
  std::optional<LinkSecurity> security;  ///< empty: none
};

/// The fixed timing of the link (doc/link.md).
inline constexpr Duration heartbeat_period = std::chrono::milliseconds{50};
inline constexpr Duration heartbeat_deadline = std::chrono::milliseconds{300};
inline constexpr Duration liveliness_lease = std::chrono::milliseconds{800};

/// Cyclone DDS's configuration for it, as XML: one interface, no multicast, the peers by address.
std::string cyclone_xml(const LinkConfig& config);

/// What the security files lack: "no governance.p7s in keys/: 'hogline keys' makes it"; empty: all are there.
std::string missing_key_file(const LinkConfig& config);

}  // namespace hogline::hw::link
