// A whole turn of the programs that stay, with keys: the skip looks, orders, and follows the stone to its rest, while
// strangers do all they can on the same link. And what a service manager hears of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/ptrace.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <thread>
#include <utility>

#include "tests/src/live/notify_socket.hpp"
#include "tests/src/live/team_scene.hpp"
#include "tests/src/live/tries.hpp"

namespace hogline::live_test {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr Duration patience = 30s;
constexpr Duration limit = 60s;
constexpr Duration watchdog = 2s;

fs::path sockets() { return fs::temp_directory_path() / ("hogline-notify-" + std::to_string(getpid())); }

/// Stops one thread of a program, as a loop that hangs: all others of its threads run on.
class HungLoop {
 public:
  explicit HungLoop(pid_t thread) : thread_(thread) {
    int status = 0;
    hangs_ = ptrace(PTRACE_SEIZE, thread, nullptr, nullptr) == 0 &&
             ptrace(PTRACE_INTERRUPT, thread, nullptr, nullptr) == 0 && waitpid(thread, &status, __WALL) == thread &&
             WIFSTOPPED(status);
  }
  ~HungLoop() { ptrace(PTRACE_DETACH, thread_, nullptr, nullptr); }
  HungLoop(const HungLoop&) = delete;
  HungLoop& operator=(const HungLoop&) = delete;
  bool hangs() const { return hangs_; }

 private:
  pid_t thread_;
  bool hangs_ = false;
};

struct SecureTurn : testing::Test {
  NotifySocket thrower_says{sockets().string() + "-thrower"};
  NotifySocket skip_says{sockets().string() + "-skip"};
  TeamScene scene{HOGLINE_PROGRAM,
                  {.secure = true,
                   .whole_skip = true,
                   .thrower_environment = thrower_says.environment(watchdog),
                   .skip_environment = skip_says.environment(watchdog)}};
  std::map<std::string, std::unique_ptr<Member>> strangers;
  bool faced_strangers = false;

  Member& stranger(const std::string& name, const std::string& robot, const std::string& keys) {
    auto& member = strangers[name];
    const std::string folder = keys.empty() ? "-" : (scene.folder() / keys).string();
    member = std::make_unique<Member>(
        name, std::vector<std::string>{HOGLINE_STRANGER, robot, std::to_string(scene.domain()), folder},
        scene.folder());
    member->start();
    return *member;
  }
  // Whoever may not be heard, and may not hear.
  void let_strangers_in() {
    scene.make_keys("others");
    // The coach's identity with the skip's permissions, which the same authority has signed for the skip.
    fs::copy(scene.folder() / "keys", scene.folder() / "borrowed");
    fs::copy(scene.folder() / "keys/skip.permissions.p7s", scene.folder() / "borrowed/coach.permissions.p7s",
             fs::copy_options::overwrite_existing);
    // ... and with permissions that another authority has signed for it.
    fs::copy(scene.folder() / "keys", scene.folder() / "forged");
    fs::copy(scene.folder() / "others/coach.permissions.p7s", scene.folder() / "forged/coach.permissions.p7s",
             fs::copy_options::overwrite_existing);
    stranger("no-keys", "skip", "");
    stranger("other-authority", "skip", "others");
    stranger("borrowed-permissions", "coach", "borrowed");
    stranger("forged-permissions", "coach", "forged");
    strangers["fast-dds"] = std::make_unique<Member>(
        "fast-dds", std::vector<std::string>{HOGLINE_FAST_DDS_SKIP, std::to_string(scene.domain())}, scene.folder());
    strangers["fast-dds"]->start();
  }
  bool thrower_tells(Stamp since, const std::string& event, const std::string& part) {
    return std::ranges::any_of(scene.thrower().told(), [&](const Told& t) {
      return t.at >= since && t.event == event && t.what.find(part) != std::string::npos;
    });
  }
  bool skip_is(Stamp since, const std::string& event, const std::string& what) {
    return std::ranges::any_of(scene.skip().told(),
                               [&](const Told& t) { return t.at >= since && t.event == event && t.what == what; });
  }
  std::string words() { return all_of(scene.rink()) + all_of(scene.thrower()) + all_of(scene.skip()); }

  // Whoever has not the keys of a robot of this team hears nothing, and nothing is heard of him.
  void nobody_hears_or_is_heard() {
    const auto speaks = [&] { return all_of(*strangers.at("no-keys")).find("sent: order") != std::string::npos; };
    EXPECT_TRUE(wait_until(speaks, patience)) << "he did speak";
    for (const char* name : {"no-keys", "other-authority", "borrowed-permissions", "forged-permissions", "fast-dds"}) {
      Member& member = *strangers.at(name);
      EXPECT_TRUE(member.running()) << name;
      EXPECT_THAT(all_of(member), Not(HasSubstr("heard"))) << name;
    }
    EXPECT_EQ(all_of(*strangers.at("fast-dds")), "");
    EXPECT_THAT(all_of(scene.thrower()), Not(HasSubstr("refused")));
    EXPECT_THAT(all_of(scene.thrower()), Not(HasSubstr("emergency")));
  }
  // A second skip, with the first one's own keys, orders what it likes.
  void second_skip_is_refused() {
    Member& second = stranger("second-skip", "skip", "keys");
    ASSERT_TRUE(
        wait_until([&] { return thrower_tells(Stamp{}, "order refused", "a second 'skip' commands"); }, patience))
        << words() << all_of(second);
  }
  // Empty: the stone was let go. Else why it was not; then it is still held.
  std::string throw_stone() {
    const Stamp begin = now();
    const auto told = [&](const char* event) { return scene.thrower().told_since(begin, event).has_value(); };
    scene.hand().start();
    if (!wait_until([&] { return told("armed"); }, patience)) return "not armed";
    scene.skip().say("order 2.2 0 1.5");
    if (!wait_until([&] { return told("throwing") || told("disarmed"); }, patience)) return "no throw began";
    if (!told("throwing")) return "disarmed before it began";
    const Stamp threw = scene.thrower().told_since(begin, "throwing")->at;
    const auto over = [&] { return scene.thrower().told_since(threw, "disarmed").has_value(); };
    if (!wait_until(over, patience)) return "the throw did not end";
    if (told("released")) return "";
    EXPECT_TRUE(scene.truth().back().held) << words();
    return scene.thrower().told_since(threw, "disarmed")->what;
  }
  // An observer of the team reads all, orders nothing, and may stop all; nobody takes his stop back for him.
  void coach_may_stop_and_no_more() {
    Member& coach = *strangers.at("coach");
    EXPECT_THAT(all_of(coach), HasSubstr("heard: state of thrower"));
    EXPECT_THAT(all_of(coach), HasSubstr("forbidden: order"));
    const Stamp begin = now();
    const auto stops = [&] { return thrower_tells(begin, "not ready", "emergency stop by 'coach'"); };
    coach.say("stop");
    EXPECT_TRUE(wait_until(stops, patience)) << words();
    const Stamp stopped = now();
    const auto other = [&] { return thrower_tells(stopped, "not ready", "") || thrower_tells(stopped, "ready", ""); };
    strangers.at("second-skip")->say("back");
    EXPECT_FALSE(wait_until(other, 500ms)) << words();
    coach.say("back");
    EXPECT_TRUE(wait_until(other, patience)) << words();
  }
  // Empty: followed to its rest. Else what came between.
  std::string follow_to_its_rest(Stamp since) {
    const auto outcome = [&] { return scene.skip().told_since(since, "outcome"); };
    const auto stopped = [&] { return scene.skip().told_since(since, "stopped"); };
    if (!wait_until([&] { return outcome() || stopped(); }, 2 * patience)) return "nothing is told of the stone";
    if (!outcome()) return "the head was stopped: " + stopped()->what;
    EXPECT_TRUE(skip_is(since, "order", "released")) << words();
    const std::string told = outcome()->what;
    double x_m = 0.0, y_m = 0.0;
    if (std::sscanf(told.c_str(), "the stone lies at %lf, %lf m", &x_m, &y_m) != 2) return told;
    EXPECT_TRUE(wait_until([&] { return scene.truth(), !scene.rests().empty(); }, patience)) << words();
    const auto& stones = scene.rests().back();
    const auto lies = std::ranges::find(stones, true, &TrueStone::thrown);
    if (lies == stones.end()) return ADD_FAILURE() << "in truth it is not there", told;
    std::printf("%s; in truth at %.3f, %.3f m\n", told.c_str(), lies->x_m, lies->y_m);
    EXPECT_LT(std::hypot(x_m - lies->x_m, y_m - lies->y_m), 0.15);
    return "";
  }
  void face_strangers() {
    let_strangers_in();
    stranger("coach", "coach", "keys");
    nobody_hears_or_is_heard();
    second_skip_is_refused();
  }
  // Empty: from the order to the stone's rest. Else what came between. The first one is played before strangers.
  std::string play_turn() {
    if (!scene.skip_waits()) return "the skip does not come to wait for a stone";
    const bool before_strangers = !std::exchange(faced_strangers, true);
    if (before_strangers) face_strangers();
    const Stamp begin = now();
    const std::string why = throw_stone();
    if (before_strangers && why.empty()) coach_may_stop_and_no_more();
    strangers.clear();  // the second skip would command as soon as the first is gone, and so as soon as we are deaf
    if (!why.empty()) return why;
    EXPECT_TRUE(thrower_tells(begin, "released", "at 2.2") || thrower_tells(begin, "released", "at 2.1")) << words();
    return follow_to_its_rest(begin);
  }
};

/// The middle one of the times between two signs of life.
Duration between(const NotifySocket& socket) {
  std::vector<Duration> spans;
  std::optional<Stamp> last;
  for (const Notification& n : socket.heard()) {
    if (n.word != "WATCHDOG=1") continue;
    if (last) spans.push_back(n.at - *last);
    last = n.at;
  }
  if (spans.empty()) return Duration::max();
  std::ranges::nth_element(spans, spans.begin() + static_cast<std::ptrdiff_t>(spans.size() / 2));
  return spans[spans.size() / 2];
}

void expect_signs_of_life_from_its_loop_alone(Member& member, const NotifySocket& socket) {
  EXPECT_GE(socket.count("READY=1"), 1) << member.name();
  EXPECT_LT(between(socket), watchdog / 2) << member.name();
  {
    const HungLoop loop(member.pid());
    ASSERT_TRUE(loop.hangs()) << member.name();
    const Stamp hung = now() + 20ms;  // what was sent before is read by then
    std::this_thread::sleep_for(watchdog * 3 / 4);
    EXPECT_EQ(socket.count("WATCHDOG=1", hung), 0) << member.name() << ": other threads speak for its control loop";
  }
  const Stamp again = now();
  EXPECT_TRUE(wait_until([&] { return socket.count("WATCHDOG=1", again) > 0; }, patience)) << member.name();
}

void expect_orderly_end(Member& member, const NotifySocket& socket) {
  const Stamp asked = now();
  member.signal(SIGTERM);
  EXPECT_TRUE(wait_until([&] { return !member.running(); }, patience)) << member.name();
  EXPECT_EQ(member.status(), 0) << member.name();
  EXPECT_TRUE(wait_until([&] { return socket.count("STOPPING=1", asked) == 1; }, patience)) << member.name();
}

// The rink runs by the wall clock: a busy machine may make a throw abort, safely, or lose the stone in its pictures.
// Then the turn is begun once more.
TEST_F(SecureTurn, is_played_to_its_rest_and_no_stranger_reads_or_changes_it) {
  Tries tries(now(), limit);
  while (tries.again(now())) {
    const Stamp begin = now();
    ASSERT_TRUE(scene.set_up()) << words();
    const std::string why = play_turn();
    if (why.empty()) {
      tries.shown();
    } else {
      tries.given_up(why, scene.was_late(begin, now()));
    }
  }
  EXPECT_TRUE(tries.fine()) << words();
  EXPECT_TRUE(faced_strangers) << words();
  expect_signs_of_life_from_its_loop_alone(scene.thrower(), thrower_says);
  expect_signs_of_life_from_its_loop_alone(scene.skip(), skip_says);
  expect_orderly_end(scene.skip(), skip_says);
  expect_orderly_end(scene.thrower(), thrower_says);
}

}  // namespace
}  // namespace hogline::live_test
