// The rig's link: what is accepted, and what is refused in which words.
#include "src/config/link_section.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src/config/config_error.hpp"
#include "src/config/device_rig.hpp"
#include "src/config/embedded.hpp"

namespace hogline::config {
namespace {

using testing::HasSubstr;

DeviceRig with_link(const std::string& lines) {
  return parse_device_rig(std::string(embedded_file("rigs/practice.yaml")) + "\nlink:\n" + lines, "rig.yaml");
}

const std::string fine = "  robot: skip\n  peers: [thrower]\n  domain: 7\n";

TEST(LinkSection, is_read) {
  const DeviceRig rig = with_link(fine + "  interface: eth0\n  addresses: [10.0.0.2]\n  security_folder: keys\n");
  ASSERT_TRUE(rig.link);
  EXPECT_EQ(rig.link->robot, "skip");
  EXPECT_THAT(rig.link->peers, testing::ElementsAre("thrower"));
  EXPECT_EQ(rig.link->domain, 7U);
  EXPECT_EQ(rig.link->interface, "eth0");
  EXPECT_THAT(rig.link->addresses, testing::ElementsAre("10.0.0.2"));
  ASSERT_TRUE(rig.link->security);
  EXPECT_EQ(rig.link->security->folder, "keys");
}

TEST(LinkSection, is_not_there_unless_the_rig_says_so) {
  EXPECT_FALSE(parse_device_rig(embedded_file("rigs/practice.yaml"), "rig.yaml").link);
}

TEST(LinkSection, refuses) {
  const struct {
    const char* what;
    std::string lines;
    const char* says;
  } cases[] = {
      {"no interface", fine, "link.interface"},
      {"a robot that is its own peer", "  robot: skip\n  peers: [skip]\n  domain: 7\n  interface: lo\n", "itself"},
      {"a network without addresses", fine + "  interface: eth0\n", "link.addresses"},
      {"a domain beyond DDS's", "  robot: skip\n  peers: [thrower]\n  domain: 233\n  interface: lo\n", "link.domain"},
      {"a name with a slash", "  robot: a/b\n  peers: [thrower]\n  domain: 7\n  interface: lo\n", "link.robot"},
      {"nobody to speak to", "  robot: skip\n  peers: []\n  domain: 7\n  interface: lo\n", "link.peers"},
      {"an address that is none", fine + "  interface: lo\n  addresses: ['<x>']\n", "link.addresses"},
  };
  for (const auto& c : cases) {
    try {
      with_link(c.lines);
      ADD_FAILURE() << c.what << " was accepted";
    } catch (const ConfigError& error) {
      EXPECT_THAT(error.what(), HasSubstr(c.says)) << c.what;
    }
  }
}

}  // namespace
}  // namespace hogline::config
