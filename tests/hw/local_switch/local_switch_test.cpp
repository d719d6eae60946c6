#include "hw/local_switch/local_switch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <system_error>

namespace hogline::hw {
namespace {

namespace fs = std::filesystem;

struct OneSwitch : testing::Test {
  std::string path = fs::temp_directory_path() / ("hogline-switch-" + std::to_string(getpid()));
  Stamp now{std::chrono::seconds(5)};
  ~OneSwitch() override { fs::remove(path); }
};

TEST_F(OneSwitch, hears_the_hand_that_presses_and_lets_go) {
  LocalSwitch pressed(path);
  SwitchHand hand(path);
  EXPECT_TRUE(hand.say(true));
  pressed.step(now);
  EXPECT_TRUE(pressed.state().held);
  EXPECT_TRUE(hand.say(false));
  pressed.step(now);
  EXPECT_FALSE(pressed.state().held);
}

TEST_F(OneSwitch, is_not_taken_from_a_program_that_listens) {
  LocalSwitch first(path);
  try {
    const LocalSwitch second(path);
    FAIL() << "the first one's operator would press in vain";
  } catch (const std::system_error& e) {
    EXPECT_EQ(e.code().value(), EADDRINUSE);
    EXPECT_THAT(e.what(), testing::HasSubstr("another program listens there"));
  }
  SwitchHand hand(path);
  EXPECT_TRUE(hand.say(true));
  first.step(now);
  EXPECT_TRUE(first.state().held);
}

TEST_F(OneSwitch, of_a_program_that_was_killed_is_no_obstacle) {
  const pid_t child = fork();
  if (child == 0) {
    const LocalSwitch left(path);
    _exit(0);
  }
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  ASSERT_TRUE(fs::is_socket(path));
  EXPECT_NO_THROW(LocalSwitch{path});
}

TEST_F(OneSwitch, does_not_remove_what_is_no_socket) {
  std::ofstream(path) << "somebody's";
  EXPECT_THROW(LocalSwitch{path}, std::system_error);
  EXPECT_TRUE(fs::is_regular_file(path));
}

}  // namespace
}  // namespace hogline::hw
