#include "src/config/link_section.hpp"

#include <algorithm>

#include "src/config/config_error.hpp"

namespace hogline::config {

hw::link::LinkConfig read_link(const Section& s, const Document& document) {
  hw::link::LinkConfig link;
  link.robot = s.word("robot");
  link.peers = s.raw("peers").get<std::vector<std::string>>();
  link.domain = static_cast<std::uint32_t>(s.integer("domain"));
  link.interface = s.word("interface");
  if (s.has("addresses")) link.addresses = s.raw("addresses").get<std::vector<std::string>>();
  if (s.has("security_folder")) link.security = hw::link::LinkSecurity{.folder = s.word("security_folder")};

  if (std::ranges::find(link.peers, link.robot) != link.peers.end()) {
    throw ConfigError(document.file, document.line_of("link.peers"), "link.peers", link.robot,
                      "must not name the robot itself");
  }
  if (link.interface != "lo" && link.addresses.empty()) {
    throw ConfigError(document.file, document.line_of("link"), "link.addresses", "",
                      "missing; interface " + link.interface + " has no multicast, so the peers' addresses are needed");
  }
  return link;
}

}  // namespace hogline::config
