// The oracle sees as well as vision does, no better: both look at the same frames of throws on the rinks on which it
// was measured.
#include "src/throwing/oracle_seer.hpp"

#include <gsl/gsl_errno.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "src/config/embedded.hpp"
#include "src/config/scenario.hpp"
#include "src/throwing/simulated_throw.hpp"

namespace hogline {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

struct Errors {
  int frames = 0;
  int seen = 0;
  PlanarPose sum;
  PlanarPose squares;
  PlanarSigma claimed;
  double nearest_m = 1e9;
  double farthest_m = 0.0;

  void add(const SheetPosePercept& percept, const PlanarPose& truth) {
    ++frames;
    if (!percept.ok) return;
    ++seen;
    const double x = percept.body.x_m - truth.x_m;
    const double y = percept.body.y_m - truth.y_m;
    const double yaw = percept.body.yaw_rad - truth.yaw_rad;
    sum = {sum.x_m + x, sum.y_m + y, sum.yaw_rad + yaw};
    squares = {squares.x_m + x * x, squares.y_m + y * y, squares.yaw_rad + yaw * yaw};
    claimed = {claimed.x_m + percept.sigma.x_m, claimed.y_m + percept.sigma.y_m,
               claimed.yaw_rad + percept.sigma.yaw_rad};
    nearest_m = std::min(nearest_m, percept.hog_distance_m);
    farthest_m = std::max(farthest_m, percept.hog_distance_m);
  }
  PlanarPose rms() const {
    return {std::sqrt(squares.x_m / seen), std::sqrt(squares.y_m / seen), std::sqrt(squares.yaw_rad / seen)};
  }
  double share() const { return static_cast<double>(seen) / frames; }
  std::string text() const {
    char line[400];
    std::snprintf(line, sizeof line,
                  "%d of %d seen, mean %.2f mm %.2f mm %.4f deg, rms %.2f mm %.2f mm %.4f deg, claimed %.2f mm %.2f mm "
                  "%.4f deg, hog %.2f..%.2f m",
                  seen, frames, 1e3 * sum.x_m / seen, 1e3 * sum.y_m / seen, sum.yaw_rad / seen / degree,
                  1e3 * rms().x_m, 1e3 * rms().y_m, rms().yaw_rad / degree, 1e3 * claimed.x_m / seen,
                  1e3 * claimed.y_m / seen, claimed.yaw_rad / seen / degree, nearest_m, farthest_m);
    return line;
  }
};

struct Compared {
  Errors near;
  Errors low;
  Errors oracle_near;
  Errors oracle_low;
};

// The throw is vision's; the oracle is asked about the same frames.
class Comparison final : public SheetSeer {
 public:
  Comparison(SheetSeer& vision, SheetSeer& oracle, const hw::sim::WorldHistory& history, Compared& all)
      : vision_(vision), oracle_(oracle), history_(history), all_(all) {}

  SheetPosePercept near_view(const hw::Frame& frame) override {
    const SheetPosePercept seen = vision_.near_view(frame);
    all_.near.add(seen, history_.at(frame.stamp).body);
    all_.oracle_near.add(oracle_.near_view(frame), history_.at(frame.stamp).body);
    return seen;
  }
  SheetPosePercept low_view(const hw::Frame& frame, const vision::LowViewPrediction& hint) override {
    const SheetPosePercept seen = vision_.low_view(frame, hint);
    all_.low.add(seen, history_.at(frame.stamp).body);
    all_.oracle_low.add(oracle_.low_view(frame, hint), history_.at(frame.stamp).body);
    return seen;
  }

 private:
  SheetSeer& vision_;
  SheetSeer& oracle_;
  const hw::sim::WorldHistory& history_;
  Compared& all_;
};

void expect_alike(const Errors& vision, const Errors& oracle) {
  const std::string both = "vision: " + vision.text() + "\noracle: " + oracle.text();
  testing::Test::RecordProperty("both", both);
  EXPECT_LT(std::abs(vision.share() - oracle.share()), 0.15) << both;
  const auto alike = [&](double seen, double drawn, const char* what) {
    EXPECT_LT(std::abs(std::log(seen / drawn)), std::log(4.0)) << what << "\n" << both;
  };
  alike(vision.rms().x_m, oracle.rms().x_m, "x");
  alike(vision.rms().y_m, oracle.rms().y_m, "y");
  alike(vision.rms().yaw_rad, oracle.rms().yaw_rad, "yaw");
  alike(vision.claimed.yaw_rad / vision.seen, oracle.claimed.yaw_rad / oracle.seen, "claimed yaw");
  alike(vision.claimed.y_m / vision.seen, oracle.claimed.y_m / oracle.seen, "claimed y");
}

// Adds one throw on a rink that the seed draws.
void throw_and_compare(std::uint64_t seed, Compared& all) {
  const auto rig = config::parse_thrower_rig(config::embedded_file("rigs/practice.yaml"), "practice rig");
  SimulatedRobot robot(rig, config::parse_scenario(config::embedded_file("scenarios/anywhere.yaml"), "anywhere", seed));
  VisionSeer vision(*rig.rig.near_camera, *rig.rig.low_camera);
  OracleSeer oracle = oracle_of(robot, rig);
  Comparison both(vision, oracle, robot.rink().history(), all);
  const Duration period = rig.drive.timing.control_period;
  boot(robot, period);
  ThrowerLoop loop(
      robot.devices(), ThrowerEyes(both, rig.looks),
      servo::Thrower(rig.thrower,
                     {.speed_mps = 2.3, .heading_rad = 0.0, .curl = servo::Curl::clockwise, .spin_radps = 1.5},
                     robot.rink().now()),
      servo::Supervisor(rig.thrower));
  ASSERT_FALSE(loop.arm(robot.rink().now()));
  while (!loop.thrower().finished()) {
    robot.rink().step(period);
    loop.step(robot.rink().now(), period);
  }
  ASSERT_FALSE(loop.thrower().abort_reason()) << *loop.thrower().abort_reason();
}

TEST(OracleSeer, errs_as_vision_does) {
  gsl_set_error_handler_off();
  Compared all;
  for (const std::uint64_t seed : {4, 5}) ASSERT_NO_FATAL_FAILURE(throw_and_compare(seed, all)) << "seed " << seed;
  std::printf("near %s\noracle %s\nlow  %s\noracle %s\n", all.near.text().c_str(), all.oracle_near.text().c_str(),
              all.low.text().c_str(), all.oracle_low.text().c_str());
  expect_alike(all.near, all.oracle_near);
  expect_alike(all.low, all.oracle_low);
}

TEST(OracleSeer, same_seed_same_percepts_and_a_folded_head_sees_nothing) {
  hw::sim::WorldHistory history(std::chrono::seconds(1));
  hw::sim::Truth truth;
  truth.stamp = Stamp{std::chrono::seconds(1)};
  truth.body = {.x_m = 0.1, .y_m = 2.0, .yaw_rad = 0.02};
  history.add(truth);
  const hw::Frame frame{.bgr = {}, .stamp = truth.stamp, .id = 7};
  OracleSeer a(history, 4.72, {}, measured_quality(), 3);
  OracleSeer b(history, 4.72, {}, measured_quality(), 3);
  OracleSeer other(history, 4.72, {}, measured_quality(), 4);
  EXPECT_FALSE(a.near_view(frame).ok);
  const auto seen = a.low_view(frame, {});
  ASSERT_TRUE(seen.ok) << seen.reason;
  EXPECT_EQ(seen.body.y_m, b.low_view(frame, {}).body.y_m);
  EXPECT_NE(seen.body.y_m, other.low_view(frame, {}).body.y_m);
  EXPECT_EQ(seen.stamp, frame.stamp);
  EXPECT_NEAR(seen.hog_distance_m, 6.401 - 2.0, 0.1);
}

}  // namespace
}  // namespace hogline
