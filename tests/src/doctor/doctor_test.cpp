// The doctor on the simulated rink: what is well, what is wrong, and that nothing moves.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>

#include "hw/modbus/axis_registers.hpp"
#include "hw/modbus/robotiq_registers.hpp"
#include "src/config/embedded.hpp"
#include "src/config/scenario.hpp"
#include "src/doctor/examination.hpp"
#include "src/doctor/report.hpp"
#include "src/doctor/simulated_site.hpp"

namespace hogline::doctor {
namespace {

// Pictures of a twenty-fifth of the size: the doctor does not look for lines.
std::string practice() {
  std::string text{config::embedded_file("rigs/practice.yaml")};
  for (const auto& [from, to] :
       {std::pair("width_px: 1600", "width_px: 320"), std::pair("height_px: 1200", "height_px: 240"),
        std::pair("fx_px: 780.0", "fx_px: 156.0"), std::pair("fy_px: 780.0", "fy_px: 156.0"),
        std::pair("cx_px: 803.2", "cx_px: 160.0"), std::pair("cy_px: 596.4", "cy_px: 120.0"),
        std::pair("fx_px: 700.0", "fx_px: 140.0"), std::pair("fy_px: 700.0", "fy_px: 140.0"),
        std::pair("cx_px: 795.7", "cx_px: 160.0"), std::pair("cy_px: 604.1", "cy_px: 120.0")}) {
    for (auto at = text.find(from); at != std::string::npos; at = text.find(from)) {
      text.replace(at, std::string(from).size(), to);
    }
  }
  return text;
}

struct Bench {
  explicit Bench(bool arm_unfolded = false) : rig(quick_rig()), robot(rig, scenario_of(arm_unfolded)), site(robot) {}

  static config::ThrowerRig quick_rig() { return config::parse_thrower_rig(practice(), "practice"); }
  static hw::sim::Scenario scenario_of(bool arm_unfolded) {
    auto scenario = config::parse_scenario(config::embedded_file("scenarios/practice.yaml"), "practice", 1);
    scenario.arm.unfolded_at_start = arm_unfolded;
    return scenario;
  }
  const std::vector<Finding>& examine() {
    findings = doctor::examine(config::devices_of(rig), site);
    return findings;
  }
  const Finding& of(const std::string& device) const {
    const auto found = std::ranges::find(findings, device, &Finding::device);
    EXPECT_NE(found, findings.end()) << device;
    return *found;
  }

  config::ThrowerRig rig;
  SimulatedRobot robot;
  SimulatedSite site;
  std::vector<Finding> findings;
};

TEST(Doctor, finds_all_well) {
  Bench bench(true);
  bench.examine();
  for (const Finding& f : bench.findings) EXPECT_EQ(f.verdict(), Verdict::ok) << f.device << "\n" << table({f});
  ASSERT_EQ(bench.findings.size(), 9U);
  EXPECT_NE(bench.of("left wheel").found.find("switch on disabled"), std::string::npos);
  EXPECT_NE(bench.of("arm").found.find("unfolded"), std::string::npos);
  for (const Finding& f : bench.findings) EXPECT_FALSE(f.values.empty()) << f.device;
}

struct Illness {
  const char* description;
  std::function<void(Bench&)> strike;
  const char* device;
  const char* says;
  std::vector<std::string> others = {};  ///< that are wrong as well
};

void PrintTo(const Illness& illness, std::ostream* out) { *out << illness.description; }

class Illnesses : public testing::TestWithParam<Illness> {};

TEST_P(Illnesses, are_found_where_they_are_with_advice) {
  const Illness& illness = GetParam();
  Bench bench(true);
  illness.strike(bench);
  bench.examine();
  const Finding& finding = bench.of(illness.device);
  EXPECT_EQ(finding.verdict(), Verdict::wrong);
  EXPECT_FALSE(all_well(bench.findings));
  const std::string text = table({finding});
  EXPECT_NE(text.find(illness.says), std::string::npos) << text;
  for (const Remark& remark : finding.remarks) EXPECT_FALSE(remark.advice.empty()) << remark.what;
  for (const Finding& f : bench.findings) {
    const bool expected = f.device == illness.device || std::ranges::count(illness.others, f.device) > 0;
    EXPECT_EQ(f.verdict() == Verdict::wrong, expected) << f.device << "\n" << table({f});
  }
}

using hw::sim::RenderedCamera;

INSTANTIATE_TEST_SUITE_P(
    Table, Illnesses,
    testing::Values(
        Illness{"a wheel's node is missing",
                [](Bench& b) { b.robot.rink().left_drive().kill(hw::sim::AxisPower::braked); }, "left wheel",
                "check its power"},
        Illness{"the other wheel's node is missing",
                [](Bench& b) { b.robot.rink().right_drive().kill(hw::sim::AxisPower::braked); }, "right wheel",
                "never answers"},
        Illness{"a node lives and does not answer",
                [](Bench& b) {
                  auto& left = b.robot.rink().left_drive().communication();
                  left.objects().set(0x1017, 0, 50);
                  left.faults.sdo_silent = true;
                },
                "left wheel", "answers no question"},
        Illness{"wrong identity", [](Bench& b) { b.rig.drive.right.product_code = 0x999; }, "right wheel",
                "wrong identity"},
        Illness{"the nodes' numbers are swapped with a stranger's", [](Bench& b) { b.rig.drive.left.vendor_id = 0x1; },
                "left wheel", "000002F1"},
        Illness{"no drive at all",
                [](Bench& b) { b.robot.rink().left_drive().communication().objects().set(0x1000, 0, 0x00030191); },
                "left wheel", "no drive"},
        Illness{"wrong mode",
                [](Bench& b) { b.robot.rink().left_drive().communication().objects().set(0x6502, 0, 1 << 2); },
                "left wheel", "wrong mode"},
        Illness{"a drive in fault",
                [](Bench& b) {
                  b.site.pass(std::chrono::milliseconds(50));
                  b.robot.rink().left_drive().raise_fault(0x3210);
                },
                "left wheel", "3210"},
        Illness{"the bus is down", [](Bench& b) { b.robot.rink().bus().set_up(false); }, "CAN bus", "down"},
        Illness{"another master", [](Bench& b) { b.robot.rink().bus().make_endpoint().send({.id = 0x080}); }, "CAN bus",
                "another master"},
        Illness{"the Modbus server is gone",
                [](Bench& b) { b.robot.rink().modbus().stop(); },
                "jaws",
                "no answer",
                {"spin belt", "arm"}},
        Illness{"the Modbus server is silent",
                [](Bench& b) { b.robot.rink().modbus().stall(); },
                "arm",
                "timeout",
                {"spin belt", "jaws"}},
        Illness{"belt and arm are swapped",
                [](Bench& b) { std::swap(b.rig.arm.unit, b.rig.gripper.belt.unit); },
                "spin belt",
                "wrong identity",
                {"arm"}},
        Illness{"nobody at the jaws' unit number", [](Bench& b) { b.rig.gripper.jaws.unit = 42; }, "jaws",
                "unit number"},
        Illness{"the gyro is silent", [](Bench& b) { b.robot.rink().gyro().set_silent(true); }, "gyro", "silent"},
        Illness{"the gyro says it is not valid", [](Bench& b) { b.robot.rink().gyro().set_valid(false); }, "gyro",
                "not valid"},
        Illness{"the gyro turns at rest, or is in another mode", [](Bench& b) { b.robot.rink().gyro().add_bias(0.5); },
                "gyro", "another mode"},
        Illness{"a camera without frames",
                [](Bench& b) { b.robot.low_camera().inject(RenderedCamera::Fault::stopped); }, "low camera",
                "0 pictures"},
        Illness{"a black picture", [](Bench& b) { b.robot.low_camera().inject(RenderedCamera::Fault::black); },
                "low camera", "black"},
        Illness{"a black picture of the unfolded head",
                [](Bench& b) { b.robot.near_camera().inject(RenderedCamera::Fault::black); }, "near camera", "black"}));

TEST(Doctor, darkness_of_a_folded_head_is_no_illness) {
  Bench bench(false);
  bench.examine();
  EXPECT_TRUE(all_well(bench.findings));
  EXPECT_EQ(bench.of("near camera").verdict(), Verdict::note);
  EXPECT_NE(bench.of("near camera").remarks.front().what.find("folded"), std::string::npos);
}

// CiA 301: an SDO request's first byte holds the command in its upper three bits; 2 reads, 3 reads on, 4 gives up.
bool only_asks(const hw::CanFrame& frame) {
  const bool sdo_request = frame.id >= 0x601 && frame.id <= 0x67F;
  const int command = frame.data[0] >> 5;
  return sdo_request && command >= 2 && command <= 4;
}

TEST(Doctor, moves_nothing_and_switches_nothing_on) {
  Bench bench;
  hw::sim::Rink& rink = bench.robot.rink();
  const auto from_a_device = [](const hw::CanFrame& frame) {
    return (frame.id >= 0x581 && frame.id <= 0x5FF) || (frame.id >= 0x701 && frame.id <= 0x77F);
  };
  int asked = 0;
  rink.bus().set_tap([&](const hw::StampedCanFrame& seen) {
    if (from_a_device(seen.frame)) return;
    EXPECT_TRUE(only_asks(seen.frame)) << std::hex << seen.frame.id << " " << int{seen.frame.data[0]};
    ++asked;
  });
  std::array<std::uint16_t, 3> jaws_before{};
  ASSERT_FALSE(bench.robot.session().read_input(9, hw::robotiq::status_address, jaws_before, bench.site.now()));
  const hw::sim::Truth before = rink.truth();

  bench.examine();

  EXPECT_GT(asked, 20);
  EXPECT_FALSE(rink.left_drive().operation_enabled() || rink.right_drive().operation_enabled());
  const hw::sim::Truth& after = rink.truth();
  EXPECT_EQ(after.body.x_m, before.body.x_m);
  EXPECT_EQ(after.body.y_m, before.body.y_m);
  EXPECT_EQ(after.left_wheel_radps, 0.0);
  EXPECT_EQ(after.arm_unfolded, before.arm_unfolded);
  EXPECT_EQ(after.held, before.held);

  // Any write would have changed an echo: go-to and activation of the jaws, sequence and watchdog of the axes.
  std::array<std::uint16_t, 3> jaws_after{};
  ASSERT_FALSE(bench.robot.session().read_input(9, hw::robotiq::status_address, jaws_after, bench.site.now()));
  EXPECT_EQ(jaws_after[0], jaws_before[0]);
  EXPECT_EQ(jaws_after[1], jaws_before[1]);
  for (const int unit : {10, 11}) {
    std::array<std::uint16_t, 8> axis{};
    ASSERT_FALSE(bench.robot.session().read_input(unit, hw::axis::status_address, axis, bench.site.now()));
    EXPECT_EQ(axis[1], 0) << "sequence echo of unit " << unit;
    EXPECT_EQ(axis[2], 0) << "watchdog echo of unit " << unit;
  }
}

}  // namespace
}  // namespace hogline::doctor
