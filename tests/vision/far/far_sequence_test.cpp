#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "hw/sim/sheet_renderer.hpp"
#include "tests/vision/far/far_score.hpp"
#include "vision/far_view/far_view.hpp"

namespace hogline::vision {
namespace {

using hogline::testing::FarScene;
using hogline::testing::random_far_scene;
using testing::far_plan_of;
using testing::far_setup_of;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double period_s = 1.0 / 30.0;

/// A stone that runs towards the skip, seen by a head that stands or turns.
class RunningStone {
 public:
  explicit RunningStone(std::uint64_t seed, int stones = 3)
      : far_(random_far_scene(seed, {.most_stones = stones, .least_stones = stones, .most_people = 0})),
        renderer_(far_.scene.setup.intrinsics, far_.scene.setup.ice, far_.scene.rink, far_.scene.sensor, seed) {}

  const FarScene& far() const { return far_; }
  Eigen::Vector2d stone(int k) const {
    return {far_.stones[0].x_m + 0.1 * k * period_s, far_.stones[0].y_m - speed_mps * k * period_s};
  }
  static Stamp stamp(int k) { return Stamp{from_seconds(k * period_s)}; }
  cv::Mat picture(int k, double panned_rad = 0.0) const {
    hw::sim::Exposure exposure = far_.scene.exposure;
    exposure.stones[0].x_m = stone(k).x();
    exposure.stones[0].y_m = stone(k).y();
    exposure.eMc = panned(far_.scene.eMc, panned_rad);
    cv::Mat bgr;
    renderer_.render(exposure, static_cast<std::uint64_t>(k), bgr);
    return bgr;
  }
  FarPlan plan(double panned_rad = 0.0) const {
    FarPlan plan = far_plan_of(far_);
    plan.eMc = panned(plan.eMc, panned_rad);
    return plan;
  }
  static Pose panned(const Pose& eMc, double rad) {
    Pose pose = eMc;
    pose.linear() = Eigen::AngleAxisd(rad, Eigen::Vector3d::UnitZ()) * eMc.linear();
    return pose;
  }

  static constexpr double speed_mps = 1.8;

 private:
  FarScene far_;
  hw::sim::SheetRenderer renderer_;
};

const StoneSighting* seen_near(const FarPercept& seen, const Eigen::Vector2d& place) {
  for (const StoneSighting& s : seen.stones) {
    if (std::abs(s.x_m - place.x()) < 0.1 && std::abs(s.y_m - place.y()) < 0.3) return &s;
  }
  return nullptr;
}

TEST(FarSequence, FollowsARunningStone) {
  for (const std::uint64_t seed : {6001U, 6002U}) {
    const RunningStone run(seed);
    FarSequence sequence(far_setup_of(run.far().scene.setup));
    for (int k = 0; k < 12; ++k) {
      const FarPercept seen = sequence.look(run.picture(k), RunningStone::stamp(k), run.plan(), {});
      ASSERT_TRUE(seen.ok) << seen.reason;
      EXPECT_LE(seen.stones.size(), 3U);
      const StoneSighting* s = seen_near(seen, run.stone(k));
      ASSERT_NE(s, nullptr) << run.far().scene.what << ", picture " << k;
      EXPECT_NEAR(s->x_m, run.stone(k).x(), 0.02);
      EXPECT_NEAR(s->y_m, run.stone(k).y(), 0.15);
    }
  }
}

TEST(FarSequence, AHeadThatTurnsKeepsTheSheet) {
  const RunningStone run(6003, 1);
  FarSequence sequence(far_setup_of(run.far().scene.setup));
  for (int k = 0; k < 8; ++k) {
    const double panned = 0.1 * degree * k;  // 3 deg/s
    const FarPercept seen = sequence.look(run.picture(k, panned), RunningStone::stamp(k), run.plan(panned), {});
    ASSERT_TRUE(seen.ok) << seen.reason;
    const Eigen::AngleAxisd off(from_row_major(seen.eMc).linear() *
                                RunningStone::panned(run.far().scene.eMc, panned).linear().transpose());
    EXPECT_LT(std::abs(off.angle()), 0.03 * degree);
    EXPECT_NE(seen_near(seen, run.stone(k)), nullptr);
  }
}

// The drives' angles jump, or somebody leans on the head: the sheet is looked for anew in the same picture.
TEST(FarSequence, AJumpOfTheHeadIsFoundAgain) {
  const RunningStone run(6004, 1);
  FarSequence sequence(far_setup_of(run.far().scene.setup));
  ASSERT_TRUE(sequence.look(run.picture(0), RunningStone::stamp(0), run.plan(), {}).ok);
  const FarPercept seen = sequence.look(run.picture(1, 0.3 * degree), RunningStone::stamp(1), run.plan(), {});
  ASSERT_TRUE(seen.ok) << seen.reason;
  EXPECT_NEAR(seen.correction.pan_rad, 0.3 * degree, 0.02 * degree);
  EXPECT_NE(seen_near(seen, run.stone(1)), nullptr);
}

TEST(FarSequence, ASpoiledPictureIsNoLoss) {
  const RunningStone run(6005, 1);
  FarSequence sequence(far_setup_of(run.far().scene.setup));
  ASSERT_TRUE(sequence.look(run.picture(0), RunningStone::stamp(0), run.plan(), {}).ok);
  const cv::Mat dark(1200, 1600, CV_8UC3, cv::Scalar::all(2));
  const FarPercept nothing = sequence.look(dark, RunningStone::stamp(1), run.plan(), {});
  EXPECT_FALSE(nothing.ok);
  EXPECT_FALSE(nothing.reason.empty());
  const FarPercept seen = sequence.look(run.picture(2), RunningStone::stamp(2), run.plan(), {});
  ASSERT_TRUE(seen.ok) << seen.reason;
  EXPECT_NE(seen_near(seen, run.stone(2)), nullptr);
}

// A stone that was covered is found where the tracker expects it, at once.
TEST(FarSequence, AnExpectedStoneIsFoundAtOnce) {
  const RunningStone run(6006, 1);
  FarSequence sequence(far_setup_of(run.far().scene.setup));
  const SheetCamera camera(Lens(run.far().scene.setup.intrinsics), run.far().scene.eMc, run.far().scene.setup.ice);
  const auto covered = [&](int k) {
    cv::Mat picture = run.picture(k);
    const auto pixel = camera.project(Eigen::Vector3d(run.stone(k).x(), run.stone(k).y(), 0.1));
    const int half = static_cast<int>(0.2 * 5600.0 / (run.stone(k).y() + 3.0));
    const cv::Point corner(static_cast<int>(pixel->x()) - half, 0);
    const cv::Point foot(static_cast<int>(pixel->x()) + half, static_cast<int>(pixel->y()) + 2 * half);
    cv::rectangle(picture, corner, foot, cv::Scalar(20, 20, 120), -1);
    return picture;
  };
  for (int k = 0; k < 6; ++k) {
    const FarPercept seen = sequence.look(covered(k), RunningStone::stamp(k), run.plan(), {});
    ASSERT_TRUE(seen.ok) << seen.reason;
    EXPECT_EQ(seen_near(seen, run.stone(k)), nullptr);
  }
  StoneExpectation expected{run.stone(6).x(), run.stone(6).y() + 0.1, {0.001, 0.0, 0.02}};
  const FarPercept seen = sequence.look(run.picture(6), RunningStone::stamp(6), run.plan(), {expected});
  ASSERT_TRUE(seen.ok) << seen.reason;
  const StoneSighting* s = seen_near(seen, run.stone(6));
  ASSERT_NE(s, nullptr);
  EXPECT_NEAR(s->y_m, run.stone(6).y(), 0.15);
}

TEST(FarSequence, ForgetsWhenToldTo) {
  const RunningStone run(6007, 1);
  FarSequence sequence(far_setup_of(run.far().scene.setup));
  ASSERT_TRUE(sequence.look(run.picture(0), RunningStone::stamp(0), run.plan(), {}).ok);
  sequence.forget();
  const FarPercept again = sequence.look(run.picture(0), RunningStone::stamp(0), run.plan(), {});
  FarSequence fresh(far_setup_of(run.far().scene.setup));
  const FarPercept first = fresh.look(run.picture(0), RunningStone::stamp(0), run.plan(), {});
  ASSERT_EQ(again.stones.size(), first.stones.size());
  EXPECT_EQ(again.eMc, first.eMc);
}

}  // namespace
}  // namespace hogline::vision
