// The two documents of DDS Security 1.1, clauses 9.4.1.2 (governance) and 9.4.1.3 (permissions).
#include <fmt/chrono.h>
#include <fmt/format.h>

#include "hw/link/team_keys.hpp"
#include "hw/link/topics.hpp"

namespace hogline::hw::link {
namespace {

std::vector<std::size_t> written_by(TeamRole role) {
  std::vector<std::size_t> kinds{TeamMessage(HeartbeatMessage{}).index(), TeamMessage(EmergencyStopMessage{}).index()};
  const auto add = [&](const TeamMessage& message) { kinds.push_back(message.index()); };
  switch (role) {
    case TeamRole::thrower:
      add(ThrowerStateMessage{});
      add(ReleaseMessage{});
      break;
    case TeamRole::skip:
      add(ShotOrderMessage{});
      add(BoardMessage{});
      add(StoneTrackMessage{});
      add(OutcomeMessage{});
      break;
    case TeamRole::observer:
      break;
  }
  return kinds;
}

std::string utc(TeamTime time) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}",
                     fmt::gmtime(std::chrono::system_clock::to_time_t(
                         std::chrono::time_point_cast<std::chrono::system_clock::duration>(time))));
}

}  // namespace

std::string governance_xml(std::uint32_t domain) {
  return fmt::format(
      R"(<?xml version="1.0" encoding="utf-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
     xsi:noNamespaceSchemaLocation="http://www.omg.org/spec/DDS-SECURITY/20170801/omg_shared_ca_governance.xsd">
  <domain_access_rules>
    <domain_rule>
      <domains><id>{}</id></domains>
      <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
      <enable_join_access_control>true</enable_join_access_control>
      <discovery_protection_kind>ENCRYPT</discovery_protection_kind>
      <liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>
      <rtps_protection_kind>SIGN</rtps_protection_kind>
      <topic_access_rules>
        <topic_rule>
          <topic_expression>*</topic_expression>
          <enable_discovery_protection>true</enable_discovery_protection>
          <enable_liveliness_protection>true</enable_liveliness_protection>
          <enable_read_access_control>true</enable_read_access_control>
          <enable_write_access_control>true</enable_write_access_control>
          <metadata_protection_kind>ENCRYPT</metadata_protection_kind>
          <data_protection_kind>ENCRYPT</data_protection_kind>
        </topic_rule>
      </topic_access_rules>
    </domain_rule>
  </domain_access_rules>
</dds>
)",
      domain);
}

std::string permissions_xml(const TeamMember& member, std::uint32_t domain, TeamTime from, TeamTime until) {
  std::string written;
  for (const std::size_t kind : written_by(member.role))
    written += fmt::format("<topic>{}</topic>", topics()[kind].name);
  return fmt::format(
      R"(<?xml version="1.0" encoding="utf-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
     xsi:noNamespaceSchemaLocation="http://www.omg.org/spec/DDS-SECURITY/20170801/omg_shared_ca_permissions.xsd">
  <permissions>
    <grant name="{0}">
      <subject_name>CN={0}</subject_name>
      <validity><not_before>{1}</not_before><not_after>{2}</not_after></validity>
      <allow_rule>
        <domains><id>{3}</id></domains>
        <publish><topics>{4}</topics><partitions><partition></partition><partition>{0}</partition></partitions></publish>
        <subscribe><topics><topic>rt/hogline/*</topic></topics></subscribe>
      </allow_rule>
      <default>DENY</default>
    </grant>
  </permissions>
</dds>
)",
      member.robot, utc(from), utc(until), domain, written);
}

}  // namespace hogline::hw::link
