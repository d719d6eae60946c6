// Keys of a team for DDS Security 1.1: one authority for identities and permissions, and per robot an identity and what
// it may write and read. P-256 and SHA-256 throughout, as the standard's built-in plugins want them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hw/team_messages.hpp"

namespace hogline::hw::link {

/// What a robot may write; everybody of the team may read everything and write heartbeats and emergency stops.
enum class TeamRole {
  thrower,   ///< its state and the release
  skip,      ///< orders, board, track and outcome
  observer,  ///< nothing more
};

struct TeamMember {
  std::string robot;  ///< the name in its rig file: letters, digits, - and _
  TeamRole role = TeamRole::observer;
};

struct TeamKeysRequest {
  std::string folder;  ///< made if it is not there; must not hold keys
  std::uint32_t domain = 0;
  std::vector<TeamMember> members;  ///< each robot once
  TeamTime from{};                  ///< the present, by the wall clock
  int days = 365;                   ///< for which they hold
};

/// Writes identity_ca.pem, permissions_ca.pem, ca.key.pem, governance.p7s and for each robot NAME.cert.pem,
/// NAME.key.pem and NAME.permissions.p7s; keys are readable by their owner alone. A robot's machine needs its own three
/// files, the two CA certificates and the governance; ca.key.pem stays at home. Throws LinkError: the folder holds keys
/// already, can not be written, a name is none or twice.
void make_team_keys(const TeamKeysRequest& request);

/// The governance document, before it is signed: who is not authenticated neither joins nor hears, and everything is
/// encrypted.
std::string governance_xml(std::uint32_t domain);
/// A robot's permissions, before they are signed.
std::string permissions_xml(const TeamMember& member, std::uint32_t domain, TeamTime from, TeamTime until);

}  // namespace hogline::hw::link
