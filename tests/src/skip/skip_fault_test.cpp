// What goes wrong while a stone comes: the head stops where it can not be trusted, and the report says what was missed.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "src/skip/skip_figures.hpp"
#include "tests/src/skip/practice.hpp"

namespace hogline::test {
namespace {

struct Case {
  const char* name;
  double after_s;  ///< the start of the rink, once
  std::function<void(SimulatedSkip&)> strike;
  const char* reason;     ///< stands in the report
  bool result;            ///< what was seen before, or by the near view alone, is a result
  double within_s = 2.5;  ///< the head stands so long after
};

class SkipFault : public testing::TestWithParam<Case> {};

TEST_P(SkipFault, stops_the_head_and_says_why) {
  const Case& c = GetParam();
  SkipRequest request = practice_throw(ThrowKind::draw, 6);
  request.scene.standing.clear();
  bool struck = false;
  double turned_rad = 0.0;
  std::optional<hw::sim::HeadTruth> stopped;
  request.interfere = [&](SimulatedSkip& robot, Stamp now) {
    const double t_s = seconds(now - robot.rink().start());
    if (t_s >= c.after_s && !struck) struck = true, c.strike(robot);
    if (t_s < c.after_s + c.within_s) return;
    const hw::sim::HeadTruth head = robot.rink().head();
    if (!stopped) stopped = head;
    turned_rad = std::max(turned_rad, std::hypot(head.pan_rad - stopped->pan_rad, head.tilt_rad - stopped->tilt_rad));
  };
  const SkipOutcome outcome = follow_throw(request);
  EXPECT_FALSE(outcome.report.ok);
  std::string all = outcome.report.reason;
  for (const std::string& remark : outcome.report.remarks) all += " | " + remark;
  EXPECT_NE(all.find(c.reason), std::string::npos) << all;
  EXPECT_LT(turned_rad, 1e-3) << "the head turned on";
  EXPECT_EQ(outcome.report.result.ok, c.result) << all;
  if (!c.result) return;
  for (const servo::StoneOutcome& stone : outcome.report.result.stones) {
    if (stone.fate == servo::StoneFate::lost) continue;
    const double miss_m =
        std::hypot(stone.x_m - outcome.stones.back().end.x_m, stone.y_m - outcome.stones.back().end.y_m);
    const double sigma_m = std::sqrt(stone.covariance.xx_m2 + stone.covariance.yy_m2);
    EXPECT_LT(miss_m, 0.01 + 4.0 * sigma_m) << "a guess";
  }
}

using Camera = hw::sim::RenderedCamera::Fault;

INSTANTIATE_TEST_SUITE_P(
    Faults, SkipFault,
    testing::Values(
        Case{"tilt_drive_fault", 10.0, [](SimulatedSkip& r) { r.rink().tilt_drive().raise_fault(0x2310); }, "head",
             true},
        Case{"pan_node_dies", 10.0, [](SimulatedSkip& r) { r.rink().pan_drive().kill(hw::sim::AxisPower::unpowered); },
             "head", true},
        Case{"head_feedback_stale", 10.0,
             [](SimulatedSkip& r) { r.rink().pan_drive().communication().faults.tpdos_stopped = true; }, "head", true},
        Case{"can_down", 10.0, [](SimulatedSkip& r) { r.rink().bus().set_up(false); }, "head", true},
        Case{"far_camera_stops", 8.0, [](SimulatedSkip& r) { r.far_camera().inject(Camera::stopped); }, "far camera",
             true},
        Case{"far_camera_frozen", 8.0, [](SimulatedSkip& r) { r.far_camera().inject(Camera::frozen); }, "far camera",
             true},
        Case{"near_camera_stops", 10.0, [](SimulatedSkip& r) { r.near_camera().inject(Camera::stopped); },
             "the near view has not seen the sheet", true, 5.5},
        Case{"near_camera_never_sees", 0.0, [](SimulatedSkip& r) { r.near_camera().inject(Camera::stopped); },
             "near camera", false},
        Case{"head_never_boots", 0.0,
             [](SimulatedSkip& r) { r.rink().pan_drive().kill(hw::sim::AxisPower::unpowered); }, "pan", false}),
    [](const auto& c) { return std::string(c.param.name); });

TEST(SkipThrow, a_stone_that_never_comes_is_not_invented) {
  SkipRequest request = practice_throw(ThrowKind::draw, 6);
  request.rig.skip.deadlines.wait = std::chrono::seconds(5);
  request.released_after = std::chrono::seconds(100);
  const SkipOutcome outcome = follow_throw(request);
  EXPECT_FALSE(outcome.report.ok);
  EXPECT_EQ(outcome.report.reason, "no stone was seen to be thrown");
}

}  // namespace
}  // namespace hogline::test
