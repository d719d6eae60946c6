// The programs that stay, together: a shot ordered by another vendor's machine is thrown, and what must not be thrown
// is not. Everything is judged by what the programs tell and by the rink's truth, nothing by how long it took.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/src/live/team_scene.hpp"
#include "tests/src/live/tries.hpp"

namespace hogline::live_test {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr Duration patience = 30s;
constexpr Duration limit = 45s;

// The next stone is there, and the operator arms: the order that was thrown comes again and again, and is refused.
void expect_no_replay_is_thrown(TeamScene& scene) {
  scene.hand().end();
  const Stamp begin = now();
  ASSERT_TRUE(scene.put_back("again")) << all_of(scene.rink());
  scene.hand().start();
  ASSERT_TRUE(wait_until([&] { return scene.thrower().told_since(begin, "armed").has_value(); }, patience))
      << all_of(scene.thrower());
  const Stamp armed = now();
  ASSERT_TRUE(wait_until([&] { return scene.thrower().told_since(armed, "order refused").has_value(); }, patience));
  EXPECT_THAT(scene.thrower().told_since(armed, "order refused")->what, HasSubstr("it is thrown once"));
  EXPECT_FALSE(scene.thrower().told_since(begin, "throwing")) << all_of(scene.thrower());
}

struct OrderedThrow : testing::Test {
  TeamScene scene{HOGLINE_PROGRAM};
  Member fast_dds{"fast-dds", {HOGLINE_FAST_DDS_SKIP, std::to_string(scene.domain())}, scene.folder()};

  bool thrower_tells(Stamp since, const char* event) {
    return wait_until([&] { return scene.thrower().told_since(since, event).has_value(); }, patience);
  }
  // Empty: the stone was let go. Else why it was not; then it is still held.
  std::string throw_by_fast_dds() {
    fast_dds.end();
    const Stamp begin = now();
    fast_dds.start();
    scene.hand().start();
    if (!thrower_tells(begin, "throwing")) return "no throw began";
    if (!thrower_tells(scene.thrower().told_since(begin, "throwing")->at, "disarmed")) return "the throw did not end";
    if (scene.thrower().told_since(begin, "released")) return "";
    EXPECT_TRUE(scene.truth().back().held);
    return scene.thrower().told_since(begin, "disarmed")->what;
  }
  void expect_told_and_true(Stamp since) {
    ASSERT_TRUE(wait_until([&] { return fast_dds.told_since(since, "released").has_value(); }, patience))
        << all_of(fast_dds);
    EXPECT_NEAR(std::stod(fast_dds.told_since(since, "released")->what), 2.25, 0.05);
    EXPECT_TRUE(scene.truth().back().released);
  }
};

// The rink runs by the wall clock: a busy machine may make a throw abort, safely. Then the next one is tried; a machine
// that makes all of them abort for lateness has shown that the order is taken, and what it can not show.
TEST_F(OrderedThrow, of_another_vendors_machine_is_thrown_by_the_thrower_on_the_rink_once) {
  Tries tries(now(), limit);
  while (tries.again(now())) {
    ASSERT_TRUE(scene.set_up()) << all_of(scene.rink()) << all_of(scene.thrower());
    const Stamp begin = now();
    const std::string why = throw_by_fast_dds();
    if (!why.empty()) {
      tries.given_up(why, scene.was_late(begin, now()));
      continue;
    }
    tries.shown();
    expect_told_and_true(begin);
    expect_no_replay_is_thrown(scene);
  }
  EXPECT_TRUE(tries.fine()) << all_of(scene.thrower()) << all_of(fast_dds);
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

std::vector<pid_t> children_of(pid_t parent) {
  std::vector<pid_t> children;
  for (const auto& process : fs::directory_iterator("/proc")) {
    std::ifstream file(process.path() / "stat");
    std::string line;
    if (!std::getline(file, line)) continue;
    int found = 0;
    char state = 0;
    const auto words = line.substr(line.rfind(')') + 2);
    if (std::sscanf(words.c_str(), "%c %d", &state, &found) != 2 || found != parent || state == 'Z') continue;
    children.push_back(std::stoi(process.path().filename()));
  }
  return children;
}

bool runs(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string line;
  return std::getline(file, line) && line.at(line.rfind(')') + 2) != 'Z';
}

TEST(Kills, leave_no_program_behind_when_they_are_killed_themselves) {
  const fs::path folder = fs::temp_directory_path() / ("hogline-killed-" + std::to_string(getpid()));
  fs::create_directories(folder);
  {
    Member kills("kills", {HOGLINE_KILLS, HOGLINE_PROGRAM, "1", "7"}, folder);
    kills.start();
    const pid_t parent = kills.pid();
    std::vector<pid_t> children;
    EXPECT_TRUE(wait_until([&] { return (children = children_of(parent)).size() >= 2; }, patience));
    kills.signal(SIGKILL);
    EXPECT_TRUE(wait_until([&] { return std::ranges::none_of(children, runs); }, patience));
    fs::remove_all(fs::temp_directory_path() / ("hogline-team-" + std::to_string(parent)));
    for (const auto& segment : fs::directory_iterator("/dev/shm"))
      if (segment.path().filename().string().starts_with("hogline-" + std::to_string(parent)))
        fs::remove(segment.path());
  }
  fs::remove_all(folder);
}

}  // namespace
}  // namespace hogline::live_test
