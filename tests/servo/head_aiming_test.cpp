#include "servo/head_aiming.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "servo/skip_sheet.hpp"
#include "tests/servo/head_plant.hpp"
#include "tests/servo/rig.hpp"
#include "tests/servo/throw_scene.hpp"

namespace hogline::servo::test {
namespace {

const PlanarPose skip_body{0.1, -4.1, 0.5 * degree};

GazeTarget target_of(const CollisionWatch& watch, Stamp stamp) {
  const World world = watch.at(stamp);
  if (!world.thrown()) return {stamp, 0.0, 29.0, 0.0, 0.0};
  const SlidingStone& s = world.thrown()->motion.stone;
  return {stamp, s.x_m, s.y_m, s.vx_mps, s.vy_mps};
}

SlidingStone true_stone(const Played& played, Stamp stamp) {
  const auto next =
      std::find_if(played.truth.begin(), played.truth.end(), [&](const TruePlace& at) { return at.stamp >= stamp; });
  if (next == played.truth.end()) return played.truth.back().stones.back();
  const SlidingStone& at = next->stones.back();
  const double ahead_s = seconds(stamp - next->stamp);
  return {at.x_m + ahead_s * at.vx_mps, at.y_m + ahead_s * at.vy_mps, at.vx_mps, at.vy_mps, 0.0};
}

bool shows(const Picture& picture, const SlidingStone& stone) {
  return std::any_of(picture.percept.stones.begin(), picture.percept.stones.end(), [&](const StoneSighting& seen) {
    return seen.team != Team::unknown && std::hypot(seen.x_m - stone.x_m, seen.y_m - stone.y_m) < 0.7;
  });
}

struct Followed {
  double rms_deg = 0.0;
  double worst_deg = 0.0;
  double worst_settled_deg = 0.0;  ///< except for one second after it came into sight, or again
  double room_rad = 0.0;
};

/// A throw followed by a head whose far camera is 0.3 deg off, by a body that is 0.05 deg and a centimetre off.
Followed follow(const Scene& scene, const Disturbance& disturbance, std::mt19937_64& random) {
  const Played played = play(scene, disturbance, random);
  const HeadGeometry true_head = head_geometry(0.25 * degree, -0.15 * degree);
  const PlanarPose true_body{skip_body.x_m + 0.01, skip_body.y_m - 0.01, skip_body.yaw_rad + 0.05 * degree};
  CollisionWatch watch(watch_config(about(scene.ice, random)), throw_start, seen_standing(scene, random));
  watch.released(signal_of(scene));
  HeadAiming aiming(aiming_config());
  HeadPlant head(*aiming.point_at(0.0, 29.2, skip_body), throw_start);
  std::normal_distribution<double> normal;
  const auto in_picture = [&](Stamp stamp, const SlidingStone& stone) {
    return seen(true_head, head.angles_at(stamp), in_body({stone.x_m, stone.y_m, 0.06}, true_body));
  };

  Followed followed;
  double square = 0.0;
  int count = 0;
  double first_seen_s = 0.0;
  std::size_t next = 0;
  const Stamp end = played.end - std::chrono::milliseconds(1000);
  while (head.now() < end) {
    for (; next < played.pictures.size() && played.pictures[next].arrives <= head.now(); ++next) {
      const Picture& picture = played.pictures[next];
      watch.look(picture.percept, picture.view);
      const Stamp stamp = picture.percept.stamp;
      const SlidingStone stone = true_stone(played, stamp);
      const auto point = in_picture(stamp, stone);
      const bool in_field = point && std::abs(point->x) < 0.14 && std::abs(point->y) < 0.1;
      if (picture.view != View::far || !in_field || !shows(picture, stone)) continue;
      aiming.look({stamp, point->x + 1e-4 * normal(random), point->y + 1e-4 * normal(random)}, target_of(watch, stamp),
                  skip_body);
    }
    const HeadAimingCommand command =
        aiming.step(head.now(), head_period, head.measured(), target_of(watch, head.now()), skip_body);
    EXPECT_TRUE(command.ok) << command.reason;
    head.step(command.pan_radps, command.tilt_radps);

    const SlidingStone stone = true_stone(played, head.now());
    if (stone.y_m > far_hog_line_m) continue;
    if (count == 0) first_seen_s = seconds(head.now() - throw_start);
    const auto point = in_picture(head.now(), stone);
    const double off_deg = point ? std::atan(std::hypot(point->x, point->y)) / degree : 90.0;
    square += off_deg * off_deg;
    ++count;
    followed.worst_deg = std::max(followed.worst_deg, off_deg);
    const double after_s = seconds(head.now() - throw_start);
    const bool first_second = after_s < first_seen_s + 1.0;
    const bool excused =
        first_second || std::any_of(disturbance.hidden.begin(), disturbance.hidden.end(), [&](double from) {
          return after_s >= from && after_s < from + disturbance.hidden_s + 1.0;
        });
    if (!excused) followed.worst_settled_deg = std::max(followed.worst_settled_deg, off_deg);
  }
  followed.rms_deg = std::sqrt(square / count);
  followed.room_rad = head.room_rad();
  return followed;
}

struct Kind {
  const char* name;
  SceneKind kind;
  bool hidden;
};

bool is_hit(SceneKind kind) { return kind == SceneKind::hit || kind == SceneKind::double_hit; }

class HeadFollows : public testing::TestWithParam<Kind> {};

TEST_P(HeadFollows, TheStoneFromTheFarHogLineToRest) {
  double worst_rms = 0.0, worst_settled = 0.0;
  for (int seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(static_cast<std::uint64_t>(50 + seed));
    const Scene scene = scene_of(GetParam().kind, random);
    Disturbance disturbance;
    if (GetParam().hidden) disturbance.hidden = {4.0 + seed, 12.0 + seed};
    const Followed followed = follow(scene, disturbance, random);
    EXPECT_LT(followed.rms_deg, 0.25);
    if (!is_hit(GetParam().kind)) {
      EXPECT_LT(followed.worst_settled_deg, 0.25);
    }
    EXPECT_GT(followed.room_rad, 0.0) << "a joint was at its limit";
    worst_rms = std::max(worst_rms, followed.rms_deg);
    worst_settled = std::max(worst_settled, followed.worst_settled_deg);
  }
  RecordProperty("rms_deg", std::to_string(worst_rms));
  RecordProperty("settled_deg", std::to_string(worst_settled));
}

INSTANTIATE_TEST_SUITE_P(Kinds, HeadFollows,
                         testing::Values(Kind{"draw", SceneKind::draw, false},
                                         Kind{"draw_hidden", SceneKind::draw, true},
                                         Kind{"guard_hidden", SceneKind::guard, true},
                                         Kind{"hit", SceneKind::hit, false}, Kind{"hit_hidden", SceneKind::hit, true},
                                         Kind{"sideline", SceneKind::sideline, false}),
                         [](const auto& kind) { return std::string(kind.param.name); });

/// A controller at rest, pointed at a place.
struct Standing {
  HeadAiming aiming{aiming_config()};
  HeadPlant head;
  explicit Standing(const HeadAngles& q) : head(q, throw_start) {}
  HeadAimingCommand step(const GazeTarget& target) {
    const HeadAimingCommand command = aiming.step(head.now(), head_period, head.measured(), target, skip_body);
    head.step(command.pan_radps, command.tilt_radps);
    return command;
  }
};

TEST(HeadAiming, ComesToAPlaceWithinASecondAndKeepsRateAndAcceleration) {
  const HeadAimingConfig config = aiming_config();
  Standing s({40.0 * degree, 30.0 * degree});
  const HeadAngles there = *s.aiming.point_at(0.5, 5.0, skip_body);
  double before = 0.0;
  for (int i = 0; i < 400; ++i) {
    const HeadAimingCommand command = s.step({s.head.now(), 0.5, 5.0, 0.0, 0.0});
    ASSERT_TRUE(command.ok);
    EXPECT_LE(std::abs(command.pan_radps), config.pan.max_speed_radps + 1e-12);
    EXPECT_LE(std::abs(command.pan_radps - before), config.pan.max_acceleration_radps2 * 0.005 + 1e-12);
    before = command.pan_radps;
  }
  EXPECT_NEAR(s.head.angles().pan_rad, there.pan_rad, 0.05 * degree);
  EXPECT_NEAR(s.head.angles().tilt_rad, there.tilt_rad, 0.05 * degree);
}

TEST(HeadAiming, SettlesWithinASecondWhenTheStoneIsFoundElsewhere) {
  Standing s(*HeadAiming(aiming_config()).point_at(0.0, 4.0, skip_body));
  // Half a metre, four degrees, aside and farther than it was thought to be.
  const HeadAngles there = *s.aiming.point_at(0.5, 4.6, skip_body);
  for (int i = 0; i < 200; ++i) s.step({s.head.now(), 0.5, 4.6, 0.0, 0.0});
  EXPECT_LT(std::hypot(s.head.angles().pan_rad - there.pan_rad, s.head.angles().tilt_rad - there.tilt_rad),
            0.25 * degree);
}

TEST(HeadAiming, StopsBeforeItsLimits) {
  HeadAimingConfig config = aiming_config();
  config.tilt.max_rad = 40.0 * degree;
  Standing s({0.0, 0.0});
  s.aiming = HeadAiming(config);
  EXPECT_FALSE(s.aiming.point_at(0.1, -3.0, skip_body)) << "beyond the limit";
  for (int i = 0; i < 600; ++i) s.step({s.head.now(), 0.1, -3.0, 0.0, 0.0});
  EXPECT_LT(s.head.angles().tilt_rad, 40.0 * degree);
  EXPECT_GT(s.head.angles().tilt_rad, 39.0 * degree);
}

TEST(HeadAiming, APictureOfSomethingElseChangesNothing) {
  Standing s(*HeadAiming(aiming_config()).point_at(0.0, 15.0, skip_body));
  const GazeTarget target{s.head.now(), 0.0, 15.0, 0.0, 0.0};
  for (int i = 0; i < 20; ++i) s.step({s.head.now(), 0.0, 15.0, 0.0, 0.0});
  const Stamp stamp = s.head.now() - head_period * 4;
  EXPECT_FALSE(s.aiming.look({stamp, 0.12, 0.0}, target, skip_body)) << "far off";
  EXPECT_FALSE(s.aiming.look({stamp, std::numeric_limits<double>::quiet_NaN(), 0.0}, target, skip_body));
  EXPECT_FALSE(s.aiming.look({throw_start - std::chrono::seconds(3), 0.0, 0.0}, target, skip_body)) << "too old";
  EXPECT_TRUE(s.aiming.look({stamp, 0.005, 0.0}, target, skip_body));
  EXPECT_FALSE(s.aiming.look({stamp, 0.005, 0.0}, target, skip_body)) << "twice";
}

TEST(HeadAiming, StandsStillWhenItKnowsTooLittleAndRecovers) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Standing s({0.0, 5.0 * degree});
  const GazeTarget good{s.head.now(), 0.0, 15.0, 0.0, 0.0};
  HeadJoints old = s.head.measured();
  old.stamp -= std::chrono::milliseconds(200);
  HeadJoints mad = s.head.measured();
  mad.angles.pan_rad = nan;
  const GazeTarget behind{s.head.now(), 0.0, -9.0, 0.0, 0.0}, lost{s.head.now(), nan, 1.0, 0.0, 0.0};
  const Stamp now = s.head.now();
  for (const HeadAimingCommand& command :
       {s.aiming.step(now, head_period, old, good, skip_body), s.aiming.step(now, head_period, mad, good, skip_body),
        s.aiming.step(now, head_period, s.head.measured(), behind, skip_body),
        s.aiming.step(now, head_period, s.head.measured(), lost, skip_body)}) {
    EXPECT_FALSE(command.ok);
    EXPECT_FALSE(command.reason.empty());
    EXPECT_EQ(command.pan_radps, 0.0);
    EXPECT_EQ(command.tilt_radps, 0.0);
  }
  EXPECT_TRUE(s.aiming.step(now, head_period, s.head.measured(), good, skip_body).ok);
}

}  // namespace
}  // namespace hogline::servo::test
