// The simulated camera's clock, laziness and faults.
#include "hw/sim/rendered_camera.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <opencv2/core.hpp>

namespace hogline::hw::sim {
namespace {

using std::chrono::milliseconds;

SheetRenderer small_renderer() {
  const vision::Intrinsics lens{160, 120, vision::LensModel::brown_conrady, 78.0, 78.0, 80.0, 60.0, {}};
  return {lens, {0.006, 1.309}, RinkAppearance{}, SensorModel{}, 3};
}

vision::Pose mount() { return vision::bMc({0.2, 0.0, 2.0, 0.0, 0.5, 0.0}); }

// Runs down the sheet at 1 m/s.
CameraWorld running() {
  CameraWorld world;
  world.body = [](Stamp t) {
    BodyMotion m;
    m.eMb = vision::eMb({0.0, -3.0 + seconds(t.time_since_epoch()), 0.0});
    m.velocity.linear = {0.0, 1.0, 0.0};
    return m;
  };
  return world;
}

RenderedCamera camera(CameraWorld world = running()) {
  return {small_renderer(), mount(), CameraTiming{}, std::move(world), 42};
}

Stamp at(int ms) { return Stamp{milliseconds(ms)}; }

TEST(RenderedCamera, DeliversEveryFrameOnceAndInOrderAfterItsLatency) {
  RenderedCamera c = camera();
  std::uint64_t expected = 0;
  for (int ms = 0; ms < 1000; ++ms) {
    const auto frame = c.latest(at(ms));
    if (!frame) continue;
    EXPECT_EQ(frame->id, expected++);
    EXPECT_EQ(frame->stamp, c.stamp_of(frame->id));
    const double age_s = seconds(at(ms) - frame->stamp);
    EXPECT_GE(age_s, 0.008);
    EXPECT_LE(age_s, 0.021);
    EXPECT_FALSE(c.latest(at(ms)).has_value()) << "never twice";
  }
  EXPECT_GE(expected, 58U);
}

TEST(RenderedCamera, ASlowReaderGetsTheNewestFrameAndSeesTheGap) {
  RenderedCamera c = camera();
  const auto first = c.latest(at(100));
  const auto second = c.latest(at(500));
  ASSERT_TRUE(first && second);
  EXPECT_GE(second->id, first->id + 23);
  EXPECT_LT(seconds(at(500) - second->stamp), 0.037);
}

TEST(RenderedCamera, AFramesBytesDoNotDependOnWhichFramesWereLookedAt) {
  RenderedCamera attentive = camera();
  RenderedCamera lazy = camera();
  std::optional<Frame> seen;
  for (int ms = 0; ms <= 400; ++ms) {
    if (auto frame = attentive.latest(at(ms))) seen = frame;
  }
  const auto only = lazy.latest(at(400));
  ASSERT_TRUE(seen && only);
  EXPECT_EQ(seen->id, only->id);
  EXPECT_EQ(cv::norm(seen->bgr, only->bgr, cv::NORM_INF), 0.0);
}

TEST(RenderedCamera, RendersOnlyWhatIsAskedFor) {
  int asked = 0;
  CameraWorld world = running();
  world.body = [&asked, inner = world.body](Stamp t) {
    ++asked;
    return inner(t);
  };
  RenderedCamera c = camera(std::move(world));
  c.latest(at(900));
  c.latest(at(901));
  EXPECT_EQ(asked, 1);
}

TEST(RenderedCamera, FaultsAndTheWayBack) {
  RenderedCamera c = camera();
  const auto good = c.latest(at(200));
  ASSERT_TRUE(good);

  c.inject(RenderedCamera::Fault::frozen);
  const auto frozen = c.latest(at(300));
  ASSERT_TRUE(frozen);
  EXPECT_EQ(frozen->stamp, good->stamp);
  EXPECT_GT(frozen->id, good->id);
  EXPECT_EQ(cv::norm(frozen->bgr, good->bgr, cv::NORM_INF), 0.0);

  c.inject(RenderedCamera::Fault::stopped);
  EXPECT_FALSE(c.latest(at(400)));

  c.inject(RenderedCamera::Fault::black);
  const auto black = c.latest(at(500));
  ASSERT_TRUE(black);
  EXPECT_LT(cv::mean(black->bgr)[0], 8.0);
  EXPECT_EQ(black->stamp, c.stamp_of(black->id));

  c.inject(RenderedCamera::Fault::none);
  const auto well = c.latest(at(600));
  ASSERT_TRUE(well);
  EXPECT_GT(cv::mean(well->bgr)[1], 40.0);
}

TEST(RenderedCamera, SeesDarknessWhileItIsFoldedAway) {
  CameraWorld world = running();
  world.uncovered = [](Stamp t) { return t >= at(500); };
  RenderedCamera c = camera(std::move(world));
  EXPECT_LT(cv::mean(c.latest(at(300))->bgr)[1], 8.0);
  EXPECT_GT(cv::mean(c.latest(at(700))->bgr)[1], 40.0);
}

}  // namespace
}  // namespace hogline::hw::sim
