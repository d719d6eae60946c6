// The jaws tried on the standing stone: what is learnt of them, and when they are not relied on.
#include "servo/jaw_rehearsal.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "servo/release_learning.hpp"
#include "tests/servo/rig.hpp"
#include "tests/servo/throw_harness.hpp"

namespace hogline::servo::test {
namespace {

const Stamp start = Stamp(std::chrono::seconds(20));

/// Jaws by the book: they answer an order to open after `delay_s`, an order to grip after 0.2 s.
struct Jaws {
  std::vector<double> delays_s;  ///< one after the other; then the last
  bool opens = true;
  bool grips = true;
  std::size_t openings = 0;
  JawTrial order = JawTrial::none;
  std::optional<Stamp> ends = std::nullopt;
  GripperObservation seen{start, true, false, 0.0, {}, {}};

  void take(JawTrial wanted, Stamp now) {
    if (wanted == order) return;
    order = wanted;
    if (order == JawTrial::open) ends = now + from_seconds(delays_s[std::min(openings++, delays_s.size() - 1)]);
    if (order == JawTrial::grip) ends = now + std::chrono::milliseconds(200);
  }
  void report(Stamp now) {
    seen.stamp = now;
    if (!ends || now < *ends) return;
    if (order == JawTrial::open && opens) {
      seen.holding = false;
      seen.open = true;
      seen.opening_since = seen.freed_at = ends;
    }
    if (order == JawTrial::grip && grips) {
      seen.holding = true;
      seen.open = false;
      seen.opening_since.reset();
    }
    ends.reset();
  }
};

struct Rehearsed {
  RehearsalStep last;
  std::vector<double> delays_s;
  double took_s = 0.0;
};

Rehearsed rehearse(Jaws jaws, int times = 3) {
  JawRehearsal rehearsal(times, 0.002);
  Stamp now = start;
  RehearsalStep step;
  while (!step.done && step.refused.empty() && now < start + std::chrono::seconds(20)) {
    now += period;
    jaws.report(now);
    step = rehearsal.step(jaws.seen, now);
    jaws.take(step.order, now);
  }
  return {step, rehearsal.delays_s(), seconds(now - start)};
}

TEST(JawRehearsal, TakesEachDelayFromTheJawsOwnReport) {
  const Rehearsed r = rehearse({.delays_s = {0.0831, 0.0854, 0.0822}});
  EXPECT_TRUE(r.last.done) << r.last.refused;
  ASSERT_EQ(r.delays_s.size(), 3U);
  EXPECT_NEAR(r.delays_s[0], 0.0831, 1e-9);
  EXPECT_NEAR(r.delays_s[1], 0.0854, 1e-9);
  EXPECT_NEAR(r.delays_s[2], 0.0822, 1e-9);
  EXPECT_LT(r.took_s, 3 * 0.5);
}

struct Distrusted {
  const char* reason;
  Jaws jaws;
};

class JawsNotReliedOn : public testing::TestWithParam<Distrusted> {};

TEST_P(JawsNotReliedOn, AreRefusedWithTheReason) {
  const Rehearsed r = rehearse(GetParam().jaws);
  EXPECT_FALSE(r.last.done);
  EXPECT_NE(r.last.refused.find(GetParam().reason), std::string::npos) << r.last.refused;
  EXPECT_EQ(r.last.order, JawTrial::none);
}

INSTANTIATE_TEST_SUITE_P(Jaws, JawsNotReliedOn,
                         testing::Values(Distrusted{"do not report", {.delays_s = {0.075}, .opens = false}},
                                         Distrusted{"do not report", {.delays_s = {2.0}}},
                                         Distrusted{"do not grip", {.delays_s = {0.075}, .grips = false}},
                                         Distrusted{"not even", {.delays_s = {0.075, 0.076, 0.1}}},
                                         Distrusted{"not held",
                                                    {.delays_s = {0.075}, .seen = {start, false, true, 0.0, {}, {}}}}));

TEST(JawRehearsal, TeachesTheDelayWhateverTheRigSaid) {
  ReleaseConfig rig;
  rig.gripper_delay_s = 0.075;
  rig.gripper_delay_sigma_s = 0.010;
  for (const double delay_s : {0.060, 0.090}) {
    const auto lesson = learn_rehearsed(prior_of(rig), {delay_s - 0.002, delay_s, delay_s + 0.002}, 0.002);
    EXPECT_EQ(lesson.refused, "");
    EXPECT_NEAR(lesson.knowledge.delay_s, delay_s, 0.0005);
    EXPECT_NEAR(std::sqrt(lesson.knowledge.covariance[0]), std::hypot(0.002, 0.001) / std::sqrt(3.0), 1e-4);
  }
  const auto absurd = learn_rehearsed(prior_of(rig), {0.075, 0.3}, 0.002);
  EXPECT_NE(absurd.refused, "");
  EXPECT_EQ(absurd.knowledge.delay_s, 0.075) << "nothing is learnt of the others either";
}

ThrowerConfig rehearsing_config() {
  ThrowerConfig config = thrower_config();
  config.release.gripper_delay_sigma_s = 0.010;
  config.release.rehearsals = 3;
  return config;
}

TEST(Rehearsal, ARobotThatHasTriedItsJawsLetsGoAtItsPlace) {
  double square = 0.0;
  int throws = 0;
  for (const double delay_s : {0.055, 0.065, 0.085, 0.095}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      PlantSettings settings = plain_settings(seed);
      settings.gripper_delay_s = delay_s;
      settings.gripper_jitter_s = 0.002;
      const Outcome o = throw_stone(rehearsing_config(), draw(), settings);
      ASSERT_TRUE(o.released && o.at_release) << delay_s << " " << seed << " " << o.abort.value_or("");
      const double error_m = o.at_release->hog_distance_m - thrower_config().release.hog_distance_m;
      EXPECT_LT(std::abs(error_m), 0.02) << delay_s << " " << seed;
      square += error_m * error_m;
      ++throws;
    }
  }
  EXPECT_LT(std::sqrt(square / throws), 0.008);
}

TEST(Rehearsal, NothingElseMovesWhileTheStoneStands) {
  const Outcome o = throw_stone(rehearsing_config(), draw(), plain_settings());
  int trials = 0;
  for (const Moment& moment : o.moments) {
    if (moment.command.gripper.trial == JawTrial::none) continue;
    ++trials;
    EXPECT_EQ(moment.state, ThrowerState::rehearse);
    EXPECT_EQ(moment.command.drive.order, DriveOrder::off);
    EXPECT_EQ(moment.command.arm, ArmOrder::hold);
    EXPECT_EQ(moment.command.gripper.spin_radps, 0.0);
    EXPECT_EQ(moment.truth.speed_mps, 0.0);
  }
  EXPECT_GT(trials, 0);
  EXPECT_TRUE(o.released);
}

TEST(Rehearsal, AStoneThatIsNotGrippedAgainEndsTheThrowInTheHack) {
  PlantSettings settings = plain_settings();
  settings.grips_again = false;
  const Outcome o = throw_stone(rehearsing_config(), draw(), settings);
  ASSERT_TRUE(o.abort);
  EXPECT_NE(o.abort->find("rehearsal: the jaws do not grip"), std::string::npos) << *o.abort;
  EXPECT_FALSE(o.reached(ThrowerState::measure));
  for (const Moment& moment : o.moments) {
    EXPECT_EQ(moment.truth.speed_mps, 0.0);
    EXPECT_NE(moment.command.drive.order, DriveOrder::velocity);
  }
}

TEST(Rehearsal, AwaitsALookAtThePlace) {
  const Spoil blind = [](ThrowerObservation& o, const Thrower& thrower) {
    if (thrower.state() == ThrowerState::rehearse) o.near_view->ok = false;
  };
  const Outcome o = throw_stone(rehearsing_config(), draw(), plain_settings(), blind);
  ASSERT_TRUE(o.abort);
  EXPECT_NE(o.abort->find("deadline of rehearse passed: near view"), std::string::npos) << *o.abort;
  for (const Moment& moment : o.moments) EXPECT_EQ(moment.command.gripper.trial, JawTrial::none);
}

}  // namespace
}  // namespace hogline::servo::test
