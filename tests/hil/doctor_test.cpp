// The doctor on the kernel's CAN interface, with foreign nodes (tests/peers/canopen_node.py) and a second socket as
// witness.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>

#include "src/config/device_rig.hpp"
#include "src/config/embedded.hpp"
#include "src/doctor/drive_check.hpp"
#include "src/doctor/report.hpp"
#include "src/doctor/steel_site.hpp"
#include "tests/hil/hil.hpp"
#include "tests/hil/process.hpp"

using namespace hogline;
using namespace hogline::hil;

namespace {

config::DeviceRig rig_on(const std::string& interface) {
  std::string text{config::embedded_file("rigs/practice.yaml")};
  const std::string from = "interface: can0";
  text.replace(text.find(from), from.size(), "interface: " + interface);
  config::DeviceRig rig = config::parse_device_rig(text, "rig.yaml");
  rig.drive->timing.sdo_timeout = 2s;  // the foreign nodes are Python on a busy machine
  return rig;
}

const doctor::Finding& of(const std::vector<doctor::Finding>& findings, const std::string& device) {
  const auto found = std::ranges::find(findings, device, &doctor::Finding::device);
  EXPECT_NE(found, findings.end()) << device;
  return *found;
}

// The doctor waits for no node: the test waits until both have sent their boot-up messages.
bool booted(hw::SocketCanBus& bus) {
  bool first = false;
  bool second = false;
  return wait_until([&] {
    for (const auto& received : period(bus)) {
      first = first || received.frame.id == 0x701;
      second = second || received.frame.id == 0x702;
    }
    return first && second;
  });
}

TEST(DoctorOnKernelCan, finds_foreign_drives_and_only_asks_them) {
  hw::SocketCanBus listener({.interface = "vcan0"}, now());
  ASSERT_TRUE(run_until(listener, [&] { return listener.up(); }));
  Process nodes(
      {HOGLINE_SOURCE_DIR "/tests/peers/canopen_node.py", "--channel", "vcan0", "--node", "1", "--node", "2"});
  ASSERT_TRUE(booted(listener));

  config::DeviceRig rig = rig_on("vcan0");
  std::vector<doctor::Finding> findings;
  std::vector<hw::StampedCanFrame> seen;
  {
    doctor::SteelSite site(rig);
    site.pass(50ms);
    findings = doctor::examine_drives(rig.drive, std::nullopt, site);
  }
  while (const auto received = listener.receive()) seen.push_back(*received);

  EXPECT_EQ(of(findings, "CAN bus").verdict(), doctor::Verdict::ok) << doctor::table(findings);
  for (const char* wheel : {"left wheel", "right wheel"}) {
    EXPECT_NE(of(findings, wheel).found.find("switch on disabled"), std::string::npos) << doctor::table(findings);
  }
  // Whatever is not an answer or a heartbeat was sent by the doctor: reading, reading on, or giving up.
  int asked = 0;
  for (const auto& received : seen) {
    const hw::CanFrame& frame = received.frame;
    if ((frame.id >= 0x581 && frame.id <= 0x5FF) || (frame.id >= 0x701 && frame.id <= 0x77F)) continue;
    const int command = frame.data[0] >> 5;
    EXPECT_TRUE(frame.id >= 0x601 && frame.id <= 0x67F && command >= 2 && command <= 4) << std::hex << frame.id;
    ++asked;
  }
  EXPECT_GT(asked, 20);
}

TEST(DoctorOnKernelCan, says_which_node_is_not_the_rigs_and_which_is_missing) {
  hw::SocketCanBus listener({.interface = "vcan0"}, now());
  ASSERT_TRUE(run_until(listener, [&] { return listener.up(); }));
  Process nodes(
      {HOGLINE_SOURCE_DIR "/tests/peers/canopen_node.py", "--channel", "vcan0", "--node", "1", "--node", "2"});
  ASSERT_TRUE(booted(listener));

  config::DeviceRig rig = rig_on("vcan0");
  rig.drive->left.vendor_id = 0x12345678;
  rig.drive->right.node = 7;
  doctor::SteelSite site(rig);
  site.pass(50ms);
  const auto findings = doctor::examine_drives(rig.drive, std::nullopt, site);
  EXPECT_NE(doctor::table({of(findings, "left wheel")}).find("12345678"), std::string::npos);
  EXPECT_NE(doctor::table({of(findings, "right wheel")}).find("never answers"), std::string::npos);
}

TEST(DoctorOnKernelCan, says_that_the_link_is_down_or_missing) {
  const config::DeviceRig rig = rig_on("nosuchcan0");
  doctor::SteelSite site(rig);
  const auto findings = doctor::examine_drives(rig.drive, std::nullopt, site);
  EXPECT_EQ(of(findings, "CAN bus").verdict(), doctor::Verdict::wrong);
  EXPECT_NE(doctor::table(findings).find("no such CAN interface"), std::string::npos) << doctor::table(findings);
}

}  // namespace
