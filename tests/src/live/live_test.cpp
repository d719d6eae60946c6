// The programs that stay, together: a shot ordered by another vendor's machine is thrown, and what must not be thrown
// is not. Everything is judged by what the programs tell and by the rink's truth, nothing by how long it took.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <thread>

#include "tests/src/live/team_scene.hpp"

namespace hogline::live_test {
namespace {

using testing::HasSubstr;

constexpr Duration patience = 60s;
constexpr int throws = 4;

// The rink runs by the wall clock: a busy machine may make a throw abort, safely. Then the next one is tried; a machine
// that makes all of them abort for lateness has shown that the order is taken, and what it can not show.
TEST(LiveTeam, a_shot_ordered_over_fast_dds_is_thrown_by_the_thrower_on_the_rink) {
  TeamScene scene(HOGLINE_PROGRAM);
  bool thrown = false;
  bool in_time = false;
  for (int i = 0; i < throws && !thrown; ++i) {
    ASSERT_TRUE(scene.set_up()) << all_of(scene.rink()) << all_of(scene.thrower());
    Member fast_dds("fast-dds-" + std::to_string(i), {HOGLINE_FAST_DDS_SKIP, std::to_string(scene.domain())},
                    scene.folder());
    const Stamp begin = now();
    fast_dds.start();
    scene.hand().start();
    ASSERT_TRUE(wait_until([&] { return scene.thrower().told_since(begin, "throwing").has_value(); }, patience))
        << all_of(scene.thrower()) << all_of(fast_dds);
    Stamp threw = scene.thrower().told_since(begin, "throwing")->at;
    ASSERT_TRUE(wait_until([&] { return scene.thrower().told_since(threw, "disarmed").has_value(); }, patience));
    thrown = scene.thrower().told_since(begin, "released").has_value();
    if (!thrown) {
      std::printf("%s", all_of(scene.thrower()).c_str());
      const auto aborted = scene.thrower().told_since(begin, "aborted");
      in_time = in_time || !aborted || !is_lateness(aborted->what);
      EXPECT_TRUE(scene.truth().back().held);
      continue;
    }
    ASSERT_TRUE(wait_until([&] { return fast_dds.told_since(begin, "released").has_value(); }, patience))
        << all_of(fast_dds);
    EXPECT_NEAR(std::stod(fast_dds.told_since(begin, "released")->what), 2.25, 0.05);
    EXPECT_TRUE(scene.truth().back().released);
  }
  EXPECT_TRUE(thrown || !in_time) << all_of(scene.thrower());
}

// Nobody holds the switch: the order is refused, and nothing moves.
TEST(LiveTeam, without_its_operator_the_thrower_throws_nothing) {
  TeamScene scene(HOGLINE_PROGRAM);
  ASSERT_TRUE(scene.set_up());
  scene.skip().start();
  ASSERT_TRUE(wait_until([&] { return scene.skip().told_since(Stamp{}, "heard").has_value(); }, patience));
  std::this_thread::sleep_for(1s);
  for (const TrueMoment& m : scene.truth()) EXPECT_FALSE(m.moves);
  EXPECT_FALSE(scene.skip().told_since(Stamp{}, "ordered"));
}

TEST(LiveTeam, programs_end_when_they_are_told_to) {
  TeamScene scene(HOGLINE_PROGRAM);
  ASSERT_TRUE(scene.set_up());
  for (Member* member : {&scene.thrower(), &scene.rink()}) {
    member->signal(SIGTERM);
    EXPECT_TRUE(wait_until([&] { return !member->running(); }, patience)) << member->name();
    EXPECT_EQ(member->status(), 0) << all_of(*member);
    EXPECT_THAT(all_of(*member), HasSubstr("end"));
  }
}

}  // namespace
}  // namespace hogline::live_test
