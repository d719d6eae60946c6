// Keys of a team for DDS Security 1.1: one authority for identities and permissions, and per robot an identity and what
// it may write and read. P-256 and SHA-256 throughout, as the standard's built-in plugins want them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hw/link/link_error.hpp"
#include "hw/team_messages.hpp"

namespace hogline::hw::link {

/// What a robot may write; everybody of the team may read everything and write heartbeats and emergency stops.
enum class TeamRole {
  thrower,   ///< its state and the release
  skip,      ///< orders, board, track and outcome
  observer,  ///< nothing more
};

struct TeamMember {
  /// The name in its rig file: up to 64 letters, digits, - and _; not ca, identity_ca, permissions_ca or governance.
  std::string robot;
  TeamRole role = TeamRole::observer;
};

struct TeamKeysRequest {
  std::string folder;  ///< made if it is not there; must not hold keys
  std::uint32_t domain = 0;
  std::vector<TeamMember> members;  ///< each robot once; names that differ in case alone are one
  TeamTime from{};                  ///< the present, by the wall clock
  int days = 365;                   ///< for which they hold
};

/// Keys that are not made because of what was asked: a name is none or twice, the folder holds keys already.
struct TeamKeysRefused : LinkError {
  using LinkError::LinkError;
};

/// Writes identity_ca.pem, permissions_ca.pem, ca.key.pem, governance.p7s and for each robot NAME.cert.pem,
/// NAME.key.pem and NAME.permissions.p7s; keys are readable by their owner alone. A robot's machine needs its own three
/// files, the two CA certificates and the governance; ca.key.pem stays at home. Throws TeamKeysRefused, and LinkError
/// where the folder can not be written; then nothing is left behind.
void make_team_keys(const TeamKeysRequest& request);

/// The governance document, before it is signed: who is not authenticated neither joins nor hears, and everything is
/// encrypted.
std::string governance_xml(std::uint32_t domain);
/// A robot's permissions, before they are signed.
std::string permissions_xml(const TeamMember& member, std::uint32_t domain, TeamTime from, TeamTime until);

}  // namespace hogline::hw::link
