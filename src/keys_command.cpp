#include "src/keys_command.hpp"

#include <fmt/format.h>

#include <chrono>

#include "hw/link/link_error.hpp"
#include "hw/link/team_keys.hpp"
#include "src/config/config_error.hpp"
#include "src/exit_status.hpp"

namespace hogline {
namespace {

std::vector<hw::link::TeamMember> members(const KeysOptions& options) {
  std::vector<hw::link::TeamMember> team{{options.thrower, hw::link::TeamRole::thrower},
                                         {options.skip, hw::link::TeamRole::skip}};
  for (const std::string& observer : options.observers) team.push_back({observer, hw::link::TeamRole::observer});
  return team;
}

}  // namespace

int run_keys(const KeysOptions& options) {
  const auto team = members(options);
  try {
    hw::link::make_team_keys({.folder = options.out,
                              .domain = static_cast<std::uint32_t>(options.domain),
                              .members = team,
                              .from = hw::TeamTime{std::chrono::system_clock::now().time_since_epoch()},
                              .days = options.days});
  } catch (const hw::link::TeamKeysRefused& error) {
    throw config::ConfigError("command line", 0, "keys", "", error.what());
  }
  fmt::print("{}: keys for {} robots in DDS domain {}, good for {} days\n", options.out, team.size(), options.domain,
             options.days);
  fmt::print("To each robot's machine, into the folder that its rig's link.security_folder names:\n");
  for (const auto& member : team) {
    fmt::print(
        "  {0}: identity_ca.pem permissions_ca.pem governance.p7s {0}.cert.pem {0}.key.pem {0}.permissions.p7s\n",
        member.robot);
  }
  fmt::print("ca.key.pem makes new members: keep it away from the robots.\n");
  return ExitStatus::success;
}

}  // namespace hogline
