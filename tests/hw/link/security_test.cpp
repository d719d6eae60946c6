// DDS Security: the team hears itself; whoever has no keys, or another team's, hears and says nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>

#include "hw/clock.hpp"
#include "hw/link/dds_team_link.hpp"
#include "hw/link/team_keys.hpp"
#include "tests/hil/process.hpp"
#include "tests/hw/link/example_messages.hpp"

namespace hogline::hw::link {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
namespace fs = std::filesystem;

Stamp now() { return SteadyClock{}.now(); }
TeamTime utc_now() { return TeamTime{std::chrono::system_clock::now().time_since_epoch()}; }

bool eventually(const std::function<bool()>& holds, Duration limit = 12s) {
  for (const Stamp end = now() + limit; now() < end; std::this_thread::sleep_for(5ms))
    if (holds()) return true;
  return holds();
}

struct Keys : testing::Test {
  std::uint32_t domain = 1 + static_cast<std::uint32_t>(getpid()) % 200;
  fs::path folder = fs::temp_directory_path() / ("hogline_keys." + std::to_string(getpid()));

  void make(const std::string& name) const {
    make_team_keys(
        {.folder = (folder / name).string(),
         .domain = domain,
         .members = {{"thrower", TeamRole::thrower}, {"skip", TeamRole::skip}, {"coach", TeamRole::observer}},
         .from = utc_now(),
         .days = 2});
  }
  LinkConfig config(const std::string& robot, const std::string& keys) const {
    LinkConfig config;
    config.robot = robot;
    config.domain = domain;
    if (!keys.empty()) config.security = LinkSecurity{.folder = (folder / keys).string()};
    return config;
  }
  ~Keys() override { fs::remove_all(folder); }
};

// A robot in a process of its own, and what it has told so far.
class Robot {
 public:
  Robot(const LinkConfig& config, const fs::path& told)
      : told_(told),
        process_({HOGLINE_LINK_PROGRAM, config.robot, std::to_string(config.domain), config.security->folder}, told) {}

  /// "heard 0 skip": a message of the first kind from the skip came in; "forbidden 0": it may not send such.
  bool says(const std::string& line) const {
    std::ifstream file(told_);
    for (std::string told; std::getline(file, told);)
      if (told == line) return true;
    return false;
  }
  bool heard_anything() const {
    std::ifstream file(told_);
    for (std::string told; std::getline(file, told);)
      if (told.starts_with("heard")) return true;
    return false;
  }

 private:
  fs::path told_;
  hil::Process process_;
};

TEST_F(Keys, are_readable_by_their_owner_alone_and_never_overwritten) {
  make("team");
  for (const char* name : {"ca.key.pem", "thrower.key.pem", "skip.key.pem"}) {
    struct stat file {};
    ASSERT_EQ(stat((folder / "team" / name).c_str(), &file), 0) << name;
    EXPECT_EQ(file.st_mode & 0777, 0600U) << name;
  }
  EXPECT_THROW(make("team"), LinkError);
}

TEST_F(Keys, are_refused_to_names_that_are_none) {
  for (const std::vector<TeamMember>& members :
       std::vector<std::vector<TeamMember>>{{},
                                            {{"", TeamRole::skip}},
                                            {{"../skip", TeamRole::skip}},
                                            {{"a<b", TeamRole::skip}},
                                            {{"skip", TeamRole::skip}, {"skip", TeamRole::thrower}}}) {
    EXPECT_THROW(
        make_team_keys({.folder = (folder / "none").string(), .domain = 0, .members = members, .from = utc_now()}),
        LinkError);
  }
}

TEST_F(Keys, hold_as_openssl_itself_judges) {
  make("team");
  const std::string team = (folder / "team").string();
  for (const std::string robot : {"thrower", "skip"})
    hil::run("openssl verify -CAfile " + team + "/identity_ca.pem " + team + "/" + robot + ".cert.pem >/dev/null");
  for (const std::string name : {"governance", "thrower.permissions", "skip.permissions"})
    hil::run("openssl smime -verify -in " + team + "/" + name + ".p7s -CAfile " + team +
             "/permissions_ca.pem -text >/dev/null 2>&1");
}

TEST_F(Keys, let_the_team_hear_itself_and_nobody_else) {
  make("team");
  make("others");
  const Robot rival(config("skip", "others"), folder / "rival.txt");
  const hil::Process foreigner({HOGLINE_FAST_DDS_PROGRAM, std::to_string(domain), "77", "3"}, folder / "foreigner.txt");
  const Robot thrower(config("thrower", "team"), folder / "thrower.txt");
  const Robot skip(config("skip", "team"), folder / "skip.txt");
  const Stamp begin = now();
  // Long enough for strangers to be found as well: without keys they hear each other within this time.
  EXPECT_TRUE(eventually([&] {
    return thrower.says("heard 0 skip") && skip.says("heard 1 thrower") && skip.says("heard 2 thrower") &&
           thrower.says("heard 7 skip") && now() - begin > 4s;
  }));
  EXPECT_FALSE(rival.heard_anything());
  EXPECT_EQ(fs::file_size(folder / "foreigner.txt"), 0U);
  EXPECT_TRUE(thrower.says("heard sessions 1 of skip")) << "the rival skip was heard too";
}

TEST_F(Keys, let_an_observer_read_but_order_nothing) {
  make("team");
  const Robot thrower(config("thrower", "team"), folder / "thrower.txt");
  const Robot coach(config("coach", "team"), folder / "coach.txt");
  EXPECT_TRUE(eventually([&] { return coach.says("heard 1 thrower") && thrower.says("heard 7 coach"); }));
  EXPECT_TRUE(coach.says("forbidden 0"));
  EXPECT_TRUE(thrower.says("forbidden 0")) << "a thrower orders nothing either";
  EXPECT_FALSE(thrower.says("heard 0 coach"));
}

// What is said is bound to who says it: by the partitions that the signed permissions allow a writer.
TEST_F(Keys, do_not_let_one_of_the_team_speak_as_another) {
  make("team");
  const Robot thrower(config("thrower", "team"), folder / "thrower.txt");
  const std::string keys = (folder / "team").string();
  const auto words_of = [&](const std::string& name) {
    std::ifstream file(folder / name);
    return std::string{std::istreambuf_iterator<char>(file), {}};
  };
  for (const std::vector<std::string>& partitions :
       {std::vector<std::string>{"skip"}, {"-", "skip"}, {"-", "coach", "skip"}, {"*"}, {"s*"}}) {
    std::vector<std::string> command{HOGLINE_IMPOSTOR_PROGRAM, std::to_string(domain), keys};
    command.insert(command.end(), partitions.begin(), partitions.end());
    const hil::Process refused(command, folder / "refused.txt");
    EXPECT_TRUE(eventually([&] { return words_of("refused.txt") == "forbidden\n"; })) << words_of("refused.txt");
    fs::remove(folder / "refused.txt");
  }
  const hil::Process nameless({HOGLINE_IMPOSTOR_PROGRAM, std::to_string(domain), keys}, folder / "nameless.txt");
  const hil::Process as_coach({HOGLINE_IMPOSTOR_PROGRAM, std::to_string(domain), keys, "-", "coach"},
                              folder / "as_coach.txt");
  EXPECT_TRUE(eventually([&] { return thrower.says("impostors"); }));
  EXPECT_THAT(words_of("nameless.txt"), HasSubstr("spoken"));
  EXPECT_THAT(words_of("as_coach.txt"), HasSubstr("spoken"));
  EXPECT_FALSE(thrower.says("heard 6 skip"));
  EXPECT_FALSE(thrower.says("heard 7 skip"));
  const Robot skip(config("skip", "team"), folder / "skip.txt");
  EXPECT_TRUE(eventually([&] { return thrower.says("heard 6 skip") && thrower.says("heard 7 skip"); }))
      << "the skip itself is heard";
}

TEST_F(Keys, take_a_process_for_each_robot) {
  make("team");
  const DdsTeamLink thrower(config("thrower", "team"), now(), utc_now());
  EXPECT_THROW(DdsTeamLink(config("skip", "team"), now(), utc_now()), LinkError);
}

TEST_F(Keys, of_another_domain_open_nothing) {
  make("team");
  LinkConfig elsewhere = config("skip", "team");
  elsewhere.domain += 1;
  EXPECT_THROW(DdsTeamLink(elsewhere, now(), utc_now()), LinkError);
}

}  // namespace
}  // namespace hogline::hw::link
