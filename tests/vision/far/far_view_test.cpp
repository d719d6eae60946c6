#include "vision/far_view/far_view.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "tests/vision/far/far_score.hpp"
#include "tests/vision/scene.hpp"

namespace hogline::vision {
namespace {

using hogline::testing::FarMix;
using hogline::testing::FarScene;
using hogline::testing::random_far_scene;
using testing::far_plan_of;
using testing::far_setup_of;
using testing::FarScore;
using testing::look_far;
using testing::score_far;

constexpr double degree = std::numbers::pi / 180.0;

// The plan turned away from the truth about the head's level axis.
FarPlan tilted_off(const Pose& truth, double tilt_rad) {
  FarPlan plan;
  plan.eMc = truth;
  const Eigen::Vector3d ahead = truth.linear().col(2);
  const Eigen::Vector3d left = Eigen::Vector3d::UnitZ().cross(ahead).normalized();
  plan.eMc.linear() = Eigen::AngleAxisd(-tilt_rad, left) * truth.linear();
  return plan;
}

struct PathTraced {
  const char* name;
  double along_m;  // allowed
};

class FarScenes : public ::testing::TestWithParam<PathTraced> {};

TEST_P(FarScenes, TheMovingStoneAndNothingElse) {
  const auto scene = testing::load_scene(GetParam().name);
  const auto truth =
      nlohmann::json::parse(std::ifstream(std::string(HOGLINE_TEST_DATA) + "/" + GetParam().name + ".json"));
  FarView view(far_setup_of(scene.setup));
  for (const double tilt_deg : {-0.5, 0.0, 0.25}) {
    const FarPercept seen = view.look(scene.image, {}, tilted_off(scene.eMc, tilt_deg * degree));
    ASSERT_TRUE(seen.ok) << seen.reason;
    EXPECT_NEAR(seen.correction.tilt_rad, tilt_deg * degree, 0.005 * degree);
    EXPECT_LT(seen.correction.tilt_sigma_rad, 0.01 * degree);
    ASSERT_EQ(seen.stones.size(), 1U);
    const auto& t = truth.at("stones").at(0);
    EXPECT_NEAR(seen.stones[0].x_m, t.at("x_end").get<double>(), 0.005);
    EXPECT_NEAR(seen.stones[0].y_m, t.at("y_end").get<double>(), GetParam().along_m);
    EXPECT_EQ(seen.stones[0].team, t.at("team") == "red" ? Team::first : Team::second);
  }
}

INSTANTIATE_TEST_SUITE_P(PathTraced, FarScenes,
                         ::testing::Values(PathTraced{"far/far-14-001", 0.06}, PathTraced{"far/far-14-004", 0.03}),
                         [](const auto& scene) { return std::string(scene.param.name).substr(11); });

// The score's own law: a stone that was missed is missed, and takes neither place nor team of one that stands beside
// it.
TEST(FarScoring, AMissedStoneDoesNotTakeItsNeighboursSighting) {
  FarScene far;
  far.stones = {{.x_m = -2.27, .y_m = 20.03, .red = false}, {.x_m = -2.15, .y_m = 20.42, .red = true}};
  FarPercept seen;
  seen.ok = true;
  seen.eMc = row_major(far.scene.eMc);
  seen.correction.tilt_sigma_rad = 1e-4;
  StoneSighting red;
  red.x_m = -2.151;
  red.y_m = 20.41;
  red.covariance = {1e-6, 0.0, 1e-4};
  red.team = Team::first;
  seen.stones.push_back(red);
  FarScore score;
  testing::add_look(far, seen, score);
  EXPECT_EQ(score.in_sight, 2);
  EXPECT_EQ(score.missed, 1);
  EXPECT_EQ(score.ghosts, 0);
  EXPECT_EQ(score.wrong_team, 0);
  EXPECT_LT(FarScore::rms(score.across_m), 0.002);
  EXPECT_LT(FarScore::rms(score.across_sigmas), 2.0);
}

// Any colours, dividers, logos, light, people and stones next door; head and mount off by up to half a degree.
TEST(FarView, OneStoneAnywhere) {
  const FarScore score = score_far(5000, 20, {.most_people = 4});
  EXPECT_EQ(score.refused, 0) << ::testing::PrintToString(score.failures);
  EXPECT_LE(score.missed, 1) << ::testing::PrintToString(score.failures);
  EXPECT_EQ(score.ghosts, 0) << ::testing::PrintToString(score.failures);
  EXPECT_EQ(score.wrong_team, 0);
  EXPECT_LT(FarScore::rms(score.across_m), 0.010);
  EXPECT_LT(FarScore::rms(score.along_m), 0.060);
  EXPECT_LT(std::abs(FarScore::mean(score.across_m)), 0.002);
  EXPECT_LT(std::abs(FarScore::mean(score.along_m)), 0.030);
  EXPECT_LT(FarScore::rms(score.across_sigmas), 2.0);
  EXPECT_LT(FarScore::rms(score.along_sigmas), 1.5);
}

TEST(FarView, TheTiltIsKnownToThousandthsOfADegree) {
  const FarScore score = score_far(5100, 8, {.most_pan_rad = 0.3 * degree});
  EXPECT_EQ(score.refused, 0) << ::testing::PrintToString(score.failures);
  EXPECT_LT(FarScore::rms(score.tilt_rad), 0.006 * degree);
  EXPECT_LT(std::abs(FarScore::mean(score.tilt_rad)), 0.003 * degree);
  EXPECT_LT(FarScore::rms(score.tilt_sigmas), 2.0);
}

TEST(FarView, EightStonesThatHideEachOther) {
  const FarScore score = score_far(5200, 6, {.most_stones = 8, .least_stones = 8, .most_people = 0});
  EXPECT_EQ(score.refused, 0) << ::testing::PrintToString(score.failures);
  EXPECT_LE(score.missed, score.in_sight / 20) << ::testing::PrintToString(score.failures);
  EXPECT_LE(score.ghosts, 1) << ::testing::PrintToString(score.failures);
  EXPECT_EQ(score.wrong_team, 0);
  EXPECT_LT(FarScore::rms(score.along_m), 0.060);
}

TEST(FarView, PeopleLogosAndTheNextSheetsStonesAreNone) {
  const FarScore score = score_far(5300, 10, testing::nobodys_stones());
  EXPECT_LE(score.refused, 1) << ::testing::PrintToString(score.failures);
  EXPECT_EQ(score.ghosts, 0) << ::testing::PrintToString(score.failures);
}

struct Beside {
  const char* what;
  std::uint64_t seed;  ///< of a crowded scene
  double x_m, y_m;     ///< where that is
  bool is_stone;
};

// What stands behind a stone or is painted before it is no part of it.
TEST(FarView, WhatIsSeenAboutAStoneIsNoneOfIt) {
  for (const Beside& b : {Beside{"red trousers behind a red handle, 9.7 m", 8141, 0.728, 9.732, true},
                          Beside{"red trousers behind a red handle, 25.7 m", 8114, 1.241, 25.671, true},
                          Beside{"black paint before the foot", 8011, 1.435, 23.959, true},
                          Beside{"grey paint under half a foot", 8093, 1.144, 15.556, true},
                          Beside{"dark paint below white ice", 8177, -1.028, 20.214, false}}) {
    const FarPercept seen = look_far(random_far_scene(b.seed, testing::crowded()));
    ASSERT_TRUE(seen.ok) << b.what << ": " << seen.reason;
    const bool found = std::any_of(seen.stones.begin(), seen.stones.end(), [&b](const StoneSighting& s) {
      return std::abs(s.x_m - b.x_m) < 0.02 && std::abs(s.y_m - b.y_m) < 0.15;
    });
    EXPECT_EQ(found, b.is_stone) << b.what;
  }
}

// Granite-grey trousers below a jacket of a team's colour.
TEST(FarView, PeopleInAStonesColoursAreNone) {
  const hw::sim::Colour granite{0.2F, 0.2F, 0.206F};
  const hw::sim::Colour red{0.55F, 0.03F, 0.03F};
  const hw::sim::Colour yellow{0.72F, 0.52F, 0.03F};
  FarScore score;
  for (std::uint64_t seed = 5320; seed < 5330; ++seed) {
    FarScene far = random_far_scene(seed, testing::nobodys_stones());
    bool in_red = seed % 2 == 0;
    for (hw::sim::PersonLook& person : far.scene.exposure.people) {
      person.jacket = in_red ? red : yellow;
      person.trousers = granite;
      in_red = !in_red;
    }
    add_look(far, look_far(far), score);
  }
  EXPECT_LE(score.refused, 1) << ::testing::PrintToString(score.failures);
  EXPECT_EQ(score.ghosts, 0) << ::testing::PrintToString(score.failures);
}

// One line across can not tell a camera that stands elsewhere from one that is tilted. What is not refused moves the
// stones by no more than half as much again as the place was wrong.
TEST(FarView, AWrongPlaceIsRefusedOrMovesTheStonesByItself) {
  struct Wrong {
    const char* what;
    double x_m, y_m;
  };
  int refused = 0;
  for (const Wrong& w : {Wrong{"along by 0.3 m", 0.0, 0.3}, Wrong{"along by 8 m", 0.0, 8.0},
                         Wrong{"across by 0.1 m", 0.1, 0.0}, Wrong{"across by 3 m", 3.0, 0.0}}) {
    for (const std::uint64_t seed : {5400U, 5401U, 5402U}) {
      const FarScene far = random_far_scene(seed, {.most_people = 0, .most_logos = 0});
      FarPlan plan = far_plan_of(far);
      plan.eMc.translation().x() += w.x_m;
      plan.eMc.translation().y() += w.y_m;
      FarView view(far_setup_of(far.scene.setup));
      const FarPercept seen = view.look(render(far.scene), {}, plan);
      if (!seen.ok) {
        ++refused;
        EXPECT_FALSE(seen.reason.empty());
        EXPECT_TRUE(seen.stones.empty());
        continue;
      }
      for (const StoneSighting& s : seen.stones) {
        EXPECT_LT(std::abs(s.x_m - far.stones[0].x_m), 1.5 * w.x_m + 0.1) << w.what << " " << far.scene.what;
        EXPECT_LT(std::abs(s.y_m - far.stones[0].y_m), 1.5 * w.y_m + 0.1) << w.what << " " << far.scene.what;
      }
    }
  }
  EXPECT_GE(refused, 4);
}

TEST(FarView, APictureWithoutLinesIsRefused) {
  const FarScene far = random_far_scene(5500);
  FarView view(far_setup_of(far.scene.setup));
  cv::Mat grey(1200, 1600, CV_8UC3, cv::Scalar(150, 150, 150));
  cv::Mat noise(1200, 1600, CV_8UC3);
  cv::theRNG().state = 7;
  cv::randu(noise, 0, 255);
  for (const cv::Mat& image : {grey, noise}) {
    const FarPercept seen = view.look(image, {}, far_plan_of(far));
    EXPECT_FALSE(seen.ok);
    EXPECT_THAT(seen.reason, ::testing::HasSubstr("how the camera looks"));
    EXPECT_TRUE(seen.stones.empty());
  }
}

TEST(FarView, WhatIsNoPictureOfThisCameraIsRefused) {
  const FarScene far = random_far_scene(5500);
  FarView view(far_setup_of(far.scene.setup));
  EXPECT_THAT(view.look(cv::Mat(), {}, far_plan_of(far)).reason, ::testing::HasSubstr("empty"));
  EXPECT_THAT(view.look(cv::Mat(600, 800, CV_8UC3, cv::Scalar::all(0)), {}, far_plan_of(far)).reason,
              ::testing::HasSubstr("800x600"));
  EXPECT_THAT(view.look(cv::Mat(1200, 1600, CV_8UC1, cv::Scalar::all(0)), {}, far_plan_of(far)).reason,
              ::testing::HasSubstr("three colours"));
  FarPlan nowhere = far_plan_of(far);
  nowhere.eMc.translation().z() = std::nan("");
  EXPECT_FALSE(view.look(render(far.scene), {}, nowhere).ok);
}

TEST(FarView, TheSameBytesGiveTheSameAnswer) {
  const FarScene far = random_far_scene(5600, {.most_stones = 3, .least_stones = 3});
  const cv::Mat picture = render(far.scene);
  FarView view(far_setup_of(far.scene.setup));
  const FarPercept first = view.look(picture, {}, far_plan_of(far));
  const FarPercept again = view.look(picture, {}, far_plan_of(far));
  const FarPercept other = FarView(far_setup_of(far.scene.setup)).look(picture, {}, far_plan_of(far));
  ASSERT_FALSE(first.stones.empty());
  for (const FarPercept* p : {&again, &other}) {
    ASSERT_EQ(p->stones.size(), first.stones.size());
    EXPECT_EQ(p->eMc, first.eMc);
    for (std::size_t i = 0; i < first.stones.size(); ++i) {
      EXPECT_EQ(p->stones[i].x_m, first.stones[i].x_m);
      EXPECT_EQ(p->stones[i].y_m, first.stones[i].y_m);
    }
  }
}

// Against differences of the projection itself: a point on the plane of the rims that one pixel shows.
TEST(FarView, AStonesWholeCovarianceFollowsTheCamera) {
  FarPercept look;
  Pose eMc = Pose::Identity();
  eMc.translation() = Eigen::Vector3d(0.3, -4.0, 2.1);
  look.eMc = row_major(eMc);
  StoneSighting stone;
  stone.x_m = 1.2;
  stone.y_m = 17.0;
  const auto seen_at = [&](const Eigen::Vector3d& place, const Eigen::Vector3d& turn) {
    const Eigen::Vector3d ray = Eigen::Vector3d(1.2, 17.0, 0.125) - eMc.translation();
    const Eigen::Vector3d turned = ray + turn.cross(ray);
    const Eigen::Vector3d eye = eMc.translation() + place;
    return Eigen::Vector2d((eye + (0.125 - eye.z()) / turned.z() * turned).head<2>());
  };
  for (int k = 0; k < 6; ++k) {
    constexpr double step = 1e-6;
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();
    (k < 3 ? place : turn)[k % 3] = step;
    const Eigen::Vector2d by = (seen_at(place, turn) - Eigen::Vector2d(1.2, 17.0)) / step;
    look.covariance.fill(0.0);
    look.covariance[static_cast<std::size_t>(7 * k)] = 1.0;
    const PlaceCovariance whole = whole_covariance(look, stone);
    EXPECT_NEAR(whole.xx_m2, by.x() * by.x(), 1e-3 * (1.0 + by.x() * by.x())) << k;
    EXPECT_NEAR(whole.xy_m2, by.x() * by.y(), 1e-3 * (1.0 + std::abs(by.x() * by.y()))) << k;
    EXPECT_NEAR(whole.yy_m2, by.y() * by.y(), 1e-3 * (1.0 + by.y() * by.y())) << k;
  }
}

}  // namespace
}  // namespace hogline::vision
