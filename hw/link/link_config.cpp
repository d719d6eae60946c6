#include "hw/link/link_config.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace hogline::hw::link {
namespace {

std::string escaped(const std::string& text) {
  std::string xml;
  for (const char c : text) {
    switch (c) {
      case '&':
        xml += "&amp;";
        break;
      case '<':
        xml += "&lt;";
        break;
      case '>':
        xml += "&gt;";
        break;
      case '"':
        xml += "&quot;";
        break;
      default:
        xml += c;
    }
  }
  return xml;
}

}  // namespace

std::string cyclone_xml(const LinkConfig& config) {
  std::string peers = "<Peer Address=\"127.0.0.1\"/>";
  if (!config.addresses.empty()) {
    peers.clear();
    for (const std::string& address : config.addresses)
      peers += fmt::format("<Peer Address=\"{}\"/>", escaped(address));
  }
  return fmt::format(
      "<Domain Id=\"any\">"
      "<General><Interfaces><NetworkInterface name=\"{}\" multicast=\"false\"/></Interfaces>"
      "<AllowMulticast>false</AllowMulticast></General>"
      "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>31</MaxAutoParticipantIndex>"
      "<SPDPInterval>500 ms</SPDPInterval><Peers>{}</Peers></Discovery>"
      "<Tracing><Verbosity>severe</Verbosity><OutputFile>stderr</OutputFile></Tracing>"
      "</Domain>",
      escaped(config.interface), peers);
}

std::string missing_key_file(const LinkConfig& config) {
  if (!config.security) return {};
  const std::filesystem::path folder = config.security->folder;
  for (const std::string& name :
       {std::string("identity_ca.pem"), std::string("permissions_ca.pem"), std::string("governance.p7s"),
        config.robot + ".cert.pem", config.robot + ".key.pem", config.robot + ".permissions.p7s"}) {
    if (!std::filesystem::is_regular_file(folder / name))
      return fmt::format("no {} in {}: 'hogline keys' makes it", name, folder.string());
  }
  return {};
}

}  // namespace hogline::hw::link
