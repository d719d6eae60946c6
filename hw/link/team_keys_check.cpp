#include "hw/link/team_keys_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>

namespace hogline::hw::link {
namespace {

namespace fs = std::filesystem;

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

void check_name(const std::string& robot) {
  const bool fine = !robot.empty() && robot.size() <= 64 && std::ranges::all_of(robot, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_';
  });
  if (!fine) throw TeamKeysRefused(fmt::format("'{}' is no name: use up to 64 letters, digits, - and _", robot));
  for (const std::string own : {"ca", "identity_ca", "permissions_ca", "governance"}) {
    if (lower(robot) == own)
      throw TeamKeysRefused(
          fmt::format("'{}' can be no robot's name: the team's own files are called so; choose another", robot));
  }
}

// Names that differ in case alone are one file on many a memory stick.
void check_names(const TeamKeysRequest& request) {
  std::set<std::string> names;
  for (const TeamMember& member : request.members) {
    check_name(member.robot);
    if (!names.insert(lower(member.robot)).second)
      throw TeamKeysRefused(fmt::format("two robots are named '{}': give each a name of its own", member.robot));
  }
  if (names.empty()) throw TeamKeysRefused("keys for nobody: name at least one robot");
}

void check_folder(const TeamKeysRequest& request) {
  const fs::path folder = request.folder;
  std::error_code nothing;
  if (fs::exists(folder, nothing) && !fs::is_directory(folder, nothing))
    throw TeamKeysRefused(fmt::format("{} is no folder: name one for the keys", request.folder));
  std::vector<std::string> names{"ca.key.pem", "identity_ca.pem", "permissions_ca.pem", "governance.p7s"};
  for (const TeamMember& member : request.members) {
    for (const char* kind : {".key.pem", ".cert.pem", ".permissions.p7s"}) names.push_back(member.robot + kind);
  }
  for (const std::string& name : names) {
    if (!fs::exists(fs::symlink_status(folder / name, nothing))) continue;
    throw TeamKeysRefused(
        fmt::format("{} holds a team's keys ({}): choose another folder, or remove it if all robots are to get "
                    "new keys",
                    request.folder, name));
  }
}

}  // namespace

void check_request(const TeamKeysRequest& request) {
  check_names(request);
  if (request.days < 1) throw TeamKeysRefused("keys must hold for at least one day");
  check_folder(request);
}

}  // namespace hogline::hw::link
