#include "servo/collision_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "servo/ice_model.hpp"
#include "servo/skip_sheet.hpp"
#include "tests/servo/throw_scene.hpp"

namespace hogline::servo::test {
namespace {

constexpr int seeds = 12;

using Pairs = std::set<std::pair<int, int>>;

/// Pairs that met and left the struck stone with this speed at least: 0.15 m/s takes it a hand's breadth.
Pairs true_pairs(const Played& played, double least_mps) {
  Pairs pairs;
  for (const PlantContact& contact : played.contacts) {
    if (contact.struck_mps >= least_mps) pairs.insert(std::minmax(contact.striker, contact.struck));
  }
  return pairs;
}

Pairs found_pairs(const ThrowResult& result) {
  Pairs pairs;
  for (const WorldCollision& hit : result.collisions) pairs.insert(std::minmax(hit.striker, hit.struck));
  return pairs;
}

bool includes(const Pairs& all, const Pairs& some) {
  return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

struct Kind {
  const char* name;
  SceneKind kind;
  bool signalled;
  bool hidden;
};

std::mt19937_64 random_of(const Kind& kind, int seed) {
  return std::mt19937_64(static_cast<std::uint64_t>(7000 + seed + 1000 * static_cast<int>(kind.kind)));
}

/// Twice hidden for two seconds; over the seeds the contact falls into it too.
Disturbance disturbance_of(const Kind& kind, int seed) {
  Disturbance disturbance;
  if (kind.hidden) disturbance.hidden = {3.0 + 0.5 * seed, 11.0 + 0.5 * seed};
  return disturbance;
}

ThrowResult watched(const Scene& scene, const Played& played, bool signalled, std::mt19937_64& random) {
  CollisionWatch watch(watch_config(about(scene.ice, random)), throw_start, seen_standing(scene, random));
  if (signalled) watch.released(signal_of(scene));
  for (const Picture& picture : played.pictures) watch.look(picture.percept, picture.view);
  EXPECT_TRUE(watch.over(played.end));
  return result_of(watch.at(played.end), scene.thrown.spin_radps, watch.config().world, {});
}

class Throws : public testing::TestWithParam<Kind> {};

TEST_P(Throws, KeepEveryIdentityAndFindEveryCollisionAndNoOther) {
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random = random_of(GetParam(), seed);
    const Scene scene = scene_of(GetParam().kind, random);
    const Played played = play(scene, disturbance_of(GetParam(), seed), random);
    const ThrowResult result = watched(scene, played, GetParam().signalled, random);
    ASSERT_TRUE(result.ok) << result.reason;
    EXPECT_TRUE(includes(found_pairs(result), true_pairs(played, 0.15))) << "a collision was missed";
    EXPECT_TRUE(includes(true_pairs(played, 0.0), found_pairs(result))) << "a collision was invented";

    const std::vector<SlidingStone>& truth = played.truth.back().stones;
    ASSERT_EQ(result.stones.size(), truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const StoneOutcome& out = result.stones[i];
      EXPECT_TRUE(out.fate == played.fates[i] || played.margins_m[i] < 0.04) << "stone " << i;
      EXPECT_EQ(out.thrown, i + 1 == truth.size());
      if (out.fate == StoneFate::sideline || out.fate == StoneFate::through) continue;
      const double miss_m = std::hypot(out.x_m - truth[i].x_m, out.y_m - truth[i].y_m);
      EXPECT_LT(miss_m, truth[i].y_m < hog_line_m ? 0.035 : 0.1) << "stone " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Throws,
                         testing::Values(Kind{"draw", SceneKind::draw, true, false},
                                         Kind{"draw_hidden_on_sight", SceneKind::draw, false, true},
                                         Kind{"guard_hidden_on_sight", SceneKind::guard, false, true},
                                         Kind{"hit", SceneKind::hit, true, false},
                                         Kind{"hit_on_sight", SceneKind::hit, false, false},
                                         Kind{"hit_hidden", SceneKind::hit, false, true},
                                         Kind{"two_hits", SceneKind::double_hit, true, false},
                                         Kind{"two_hits_hidden", SceneKind::double_hit, true, true},
                                         Kind{"through_hidden", SceneKind::through, true, true},
                                         Kind{"hogged_hidden", SceneKind::hogged, true, true},
                                         Kind{"sideline_on_sight", SceneKind::sideline, false, false}),
                         [](const auto& kind) { return std::string(kind.param.name); });

// What the skip knows of the running stone at each moment, region by region.
struct Region {
  double square_m2 = 0.0;
  double normalised = 0.0;
  int count = 0;
  void add(double dx, double dy, const MotionCovariance& c) {
    square_m2 += dx * dx + dy * dy;
    const double det = c(0, 0) * c(1, 1) - c(0, 1) * c(0, 1);
    normalised += 0.5 * (c(1, 1) * dx * dx - 2.0 * c(0, 1) * dx * dy + c(0, 0) * dy * dy) / det;
    ++count;
  }
  double rms_m() const { return std::sqrt(square_m2 / count); }
  double normalised_rms() const { return std::sqrt(normalised / count); }
};

TEST(CollisionWatch, FollowsTheStoneFromHogLineToHouseWithoutAJump) {
  Region far_hog, near_hog, house;
  double greatest_jump_m = 0.0;
  const Kind draw{"draw", SceneKind::draw, false, false};
  for (int seed = 0; seed < 20; ++seed) {
    std::mt19937_64 random = random_of(draw, 100 + seed);
    Scene scene = scene_of(draw.kind, random);
    scene.standing.clear();
    const Played played = play(scene, {.jitter_s = 0.0}, random);
    CollisionWatch watch(watch_config(about(scene.ice, random)), throw_start, {});
    std::size_t moment = 0;
    for (const Picture& picture : played.pictures) {
      const Stamp stamp = picture.percept.stamp;
      const World before = watch.at(stamp + Duration(5));
      watch.look(picture.percept, picture.view);
      if (picture.view == View::far) continue;
      const SlidingStone& truth = played.truth[moment++].stones.back();
      const World after = watch.at(stamp + Duration(5));
      if (!after.thrown() || !before.thrown()) continue;
      const StoneMotion& motion = after.thrown()->motion;
      const double dx = motion.stone.x_m - truth.x_m, dy = motion.stone.y_m - truth.y_m;
      if (truth.y_m > 26.0) far_hog.add(dx, dy, motion.covariance);
      if (truth.y_m > 6.4 && truth.y_m < 8.0) near_hog.add(dx, dy, motion.covariance);
      if (truth.y_m < 1.8) house.add(dx, dy, motion.covariance);
      if (truth.y_m < 8.0 && truth.y_m > 5.0) {
        const SlidingStone& was = before.thrown()->motion.stone;
        greatest_jump_m = std::max(greatest_jump_m, std::hypot(motion.stone.x_m - was.x_m, motion.stone.y_m - was.y_m));
      }
    }
  }
  RecordProperty("far_hog_mm", std::to_string(1e3 * far_hog.rms_m()));
  RecordProperty("near_hog_mm", std::to_string(1e3 * near_hog.rms_m()));
  RecordProperty("house_mm", std::to_string(1e3 * house.rms_m()));
  RecordProperty("jump_mm", std::to_string(1e3 * greatest_jump_m));
  EXPECT_LT(far_hog.rms_m(), 0.150);
  EXPECT_LT(near_hog.rms_m(), 0.060);
  EXPECT_LT(house.rms_m(), 0.015);
  EXPECT_LT(greatest_jump_m, 0.030) << "between what was foretold and what is known a look later";
  for (const Region* region : {&far_hog, &near_hog, &house}) {
    EXPECT_GT(region->normalised_rms(), 0.7);
    EXPECT_LT(region->normalised_rms(), 1.3);
  }
}

TEST(CollisionWatch, ForetellsTheStopWhileTheStoneRuns) {
  const Kind draw{"draw", SceneKind::draw, true, false};
  double along_square = 0.0, across_square = 0.0;
  const int throws = 30;
  for (int seed = 0; seed < throws; ++seed) {
    std::mt19937_64 random = random_of(draw, 300 + seed);
    Scene scene = scene_of(draw.kind, random);
    scene.standing.clear();
    const Played played = play(scene, {}, random);
    // This ice has neither lanes nor sweepers nor throws that differ: with their noise the sigmas would be too large.
    CollisionWatchConfig config = watch_config(about(scene.ice, random));
    config.world.noise = {.place_m = 0.0, .velocity_mps = 0.0, .friction = 0.0, .curl = 0.0};
    config.world.throw_friction_sigma = 1e-4;
    CollisionWatch watch(config, throw_start, {});
    watch.released(signal_of(scene));
    Stamp now{};
    for (const Picture& picture : played.pictures) {
      watch.look(picture.percept, picture.view);
      now = picture.percept.stamp;
      if (watch.at(now).thrown()->motion.stone.y_m < 10.0) break;
    }
    const StoneMotion motion = watch.at(now).thrown()->motion;
    const StopPrediction stop = predict_stop(motion.stone, motion.ice, motion_covariance(motion));
    const SlidingStone& truth = played.truth.back().stones.back();
    along_square += std::pow((stop.y_m - truth.y_m) / std::sqrt(stop.covariance.yy_m2), 2);
    across_square += std::pow((stop.x_m - truth.x_m) / std::sqrt(stop.covariance.xx_m2), 2);
  }
  for (const double square : {along_square, across_square}) {
    EXPECT_GT(std::sqrt(square / throws), 0.7);
    EXPECT_LT(std::sqrt(square / throws), 1.3);
  }
}

TEST(CollisionWatch, TimesCurlAndRotationAreWhatTheyWereWithinTheirSigmas) {
  double hog_square = 0.0, rest_square = 0.0, spin_square = 0.0, worst_hog_s = 0.0;
  const Kind draw{"draw", SceneKind::draw, false, true};
  const int throws = 20;
  for (int seed = 0; seed < throws; ++seed) {
    std::mt19937_64 random = random_of(draw, 200 + seed);
    Scene scene = scene_of(draw.kind, random);
    scene.standing.clear();
    const Played played = play(scene, {}, random);
    const ThrowResult result = watched(scene, played, seed % 2 == 0, random);
    ASSERT_TRUE(result.hog_to_hog_s && result.hog_to_rest_s && result.curl_m && result.rotation.ok) << seed;
    const StonePath truth(scene.thrown, scene.ice);
    const double hog_s = *truth.crossing_s(hog_line_m) - *truth.crossing_s(far_hog_line_m);
    const double rest_s = truth.rest().after_s - *truth.crossing_s(far_hog_line_m);
    worst_hog_s = std::max(worst_hog_s, std::abs(result.hog_to_hog_s->value - hog_s));
    hog_square += std::pow((result.hog_to_hog_s->value - hog_s) / result.hog_to_hog_s->sigma, 2);
    rest_square += std::pow((result.hog_to_rest_s->value - rest_s) / result.hog_to_rest_s->sigma, 2);
    const double spin = truth.at(seconds(result.fit.start - throw_start)).stone.spin_radps;
    spin_square += std::pow(result.rotation.spin_radps - spin, 2);
    EXPECT_EQ(result.curl_m->value > 0.0, scene.thrown.spin_radps > 0.0) << seed;
    ASSERT_TRUE(result.track);
    EXPECT_EQ(result.track->spin_radps > 0.0, scene.thrown.spin_radps > 0.0);
  }
  RecordProperty("worst_hog_to_hog_s", std::to_string(worst_hog_s));
  EXPECT_LT(worst_hog_s, 0.05);
  EXPECT_LT(std::sqrt(hog_square / throws), 1.5);
  EXPECT_GT(std::sqrt(hog_square / throws), 0.5);
  EXPECT_LT(std::sqrt(rest_square / throws), 1.5);
  EXPECT_LT(std::sqrt(spin_square / throws), 0.05);
}

TEST(CollisionWatch, LateAndShuffledPicturesGiveWhatPromptOnesGive) {
  const Kind kind{"two", SceneKind::double_hit, true, false};
  std::mt19937_64 random = random_of(kind, 3);
  const Scene scene = scene_of(kind.kind, random);
  const Played late = play(scene, {.latency_s = 0.02, .jitter_s = 0.25}, random);
  std::vector<Picture> prompt = late.pictures;
  std::stable_sort(prompt.begin(), prompt.end(), [](const Picture& a, const Picture& b) {
    return a.percept.stamp != b.percept.stamp ? a.percept.stamp < b.percept.stamp : a.view < b.view;
  });
  const IceEstimate ice = about(scene.ice, random);
  const std::vector<StoneSighting> standing = seen_standing(scene, random);
  const auto end_of = [&](const std::vector<Picture>& pictures) {
    CollisionWatch watch(watch_config(ice), throw_start, standing);
    watch.released(signal_of(scene));
    for (const Picture& picture : pictures) EXPECT_NE(watch.look(picture.percept, picture.view), Fusion::too_old);
    return watch.at(late.end);
  };
  const World a = end_of(late.pictures), b = end_of(prompt);
  ASSERT_EQ(a.stones.size(), b.stones.size());
  EXPECT_EQ(a.collisions.size(), b.collisions.size());
  for (std::size_t i = 0; i < a.stones.size(); ++i) {
    EXPECT_NEAR(a.stones[i].motion.stone.x_m, b.stones[i].motion.stone.x_m, 1e-4) << i;
    EXPECT_NEAR(a.stones[i].motion.stone.y_m, b.stones[i].motion.stone.y_m, 1e-4) << i;
  }
}

TEST(CollisionWatch, NothingIsBornOfFalseLooks) {
  std::mt19937_64 random(11);
  Scene scene;
  scene.ice = {1.0, 0.9, 0.0};
  CollisionWatch watch(watch_config(about(scene.ice, random)), throw_start, {});
  std::uniform_real_distribution<double> x(-2.2, 2.2), y(-1.5, 25.0);
  Stamp now = throw_start;
  for (int i = 0; i < 600; ++i) {
    now += std::chrono::milliseconds(33);
    StonesPercept percept;
    percept.ok = true;
    percept.stamp = now;
    StoneSighting seen;
    seen.x_m = x(random), seen.y_m = y(random);
    seen.covariance = {1e-3, 0.0, 4e-3};
    if (i % 3 == 0) percept.stones.push_back(seen);
    watch.look(percept, i % 2 == 0 ? View::far : View::near);
  }
  const World world = watch.at(now);
  EXPECT_EQ(world.thrown(), nullptr);
  EXPECT_FALSE(watch.over(now));
  const ThrowResult result = result_of(world, 0.0, watch.config().world, {});
  EXPECT_FALSE(result.ok);
  EXPECT_EQ(result.reason, "no stone was seen to be thrown");
}

TEST(CollisionWatch, AStoneLastSeenRunningToTheSidelineIsOutWhenItMustHaveGoneOverIt) {
  std::mt19937_64 random(13);
  const Scene scene = scene_of(SceneKind::hit, random);
  CollisionWatch watch(watch_config(about(scene.ice, random)), throw_start, seen_standing(scene, random));
  World world = watch.at(throw_start);
  WorldConfig config = watch.config().world;
  config.sheet_width_m = 4.72;
  ASSERT_FALSE(world.stones.empty());
  WorldStone& stone = world.stones.front();
  stone.phase = StonePhase::moving;
  stone.has_moved = true;
  const auto fate_at = [&](double x_m) {
    stone.motion.stone.x_m = x_m;
    return result_of(world, 0.0, config, {}).stones.front().fate;
  };
  EXPECT_EQ(fate_at(2.9), StoneFate::sideline);
  EXPECT_EQ(fate_at(-3.6), StoneFate::sideline);
  EXPECT_NE(fate_at(2.1), StoneFate::sideline);
}

TEST(CollisionWatch, WhatCanNotBeUsedChangesNothing) {
  std::mt19937_64 random(12);
  const Scene scene = scene_of(SceneKind::guard, random);
  CollisionWatch watch(watch_config(about(scene.ice, random)), throw_start, seen_standing(scene, random));
  watch.released(signal_of(scene));
  StonesPercept blind;
  blind.stamp = throw_start + std::chrono::milliseconds(100);
  blind.reason = "black";
  EXPECT_EQ(watch.look(blind, View::far), Fusion::gated);
  StonesPercept mad = blind;
  mad.ok = true;
  StoneSighting seen;
  seen.x_m = std::numeric_limits<double>::quiet_NaN();
  seen.covariance = {1e-3, 0.0, 1e-3};
  mad.stones = {seen, StoneSighting{}};
  EXPECT_EQ(watch.look(mad, View::far), Fusion::accepted);
  const World world = watch.at(throw_start + std::chrono::seconds(1));
  EXPECT_TRUE(std::isfinite(world.thrown()->motion.stone.y_m));
  EXPECT_EQ(world.stones.size(), scene.standing.size() + 1);
  StonesPercept ancient = mad;
  ancient.stamp = throw_start - std::chrono::seconds(1);
  EXPECT_EQ(watch.look(ancient, View::near), Fusion::too_old);
}

}  // namespace
}  // namespace hogline::servo::test
