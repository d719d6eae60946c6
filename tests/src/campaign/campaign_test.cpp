// A campaign can be stopped, taken up, thrown by several at a time and picked apart, and is the same campaign.
#include <gsl/gsl_errno.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "src/campaign/folder.hpp"
#include "src/campaign/recall.hpp"
#include "src/campaign/throwing_crew.hpp"
#include "src/config/config_error.hpp"
#include "src/config/embedded.hpp"

namespace hogline::campaign {
namespace {

namespace fs = std::filesystem;

PlanText practice(std::uint64_t seed = 3) {
  return {.rig = std::string(config::embedded_file("rigs/practice.yaml")),
          .scenario = std::string(config::embedded_file("scenarios/practice.yaml")),
          .seed = seed,
          .eyes = Eyes::oracle,
          .speed_mps = {2.0, 2.6},
          .heading_deg = {-1.0, 1.0},
          .spin_radps = {1.0, 2.0},
          .turn = Turn::both,
          .tee_draws = false,
          .without = Without::nothing};
}

std::string content(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

class Campaign : public testing::Test {
 protected:
  void SetUp() override {
    gsl_set_error_handler_off();
    std::string name = (fs::temp_directory_path() / "campaign-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    root_ = name;
  }
  void TearDown() override { fs::remove_all(root_); }

  std::string folder(const char* name) const { return (root_ / name).string(); }
  std::string table(const char* name) const { return folder(name) + "/throws.csv"; }
  // Rows of throws that nobody threw: what is tested is the table.
  void fill(const char* name, const Plan& plan, int rows) const {
    Folder open(folder(name), plan, "program");
    for (int i = static_cast<int>(open.rows().size()); i < rows; ++i) {
      open.append(row_of(plan.draw(i), ThrowResult{}));
    }
  }
  void refuses(const char* name, const PlanText& text, const std::string& program, const std::string& because) const {
    try {
      Folder(folder(name), Plan(text), program);
      FAIL() << "taken up, though it should be refused: " << because;
    } catch (const config::ConfigError& e) {
      EXPECT_NE(std::string(e.what()).find(because), std::string::npos) << e.what();
    }
  }

 private:
  fs::path root_;
};

TEST_F(Campaign, gives_the_same_bytes_whatever_the_jobs_and_interruptions) {
  const Plan plan(practice());
  {
    Folder one(folder("one"), plan, "program");
    throw_missing(plan, 3, 1, one, {});
  }
  {
    Folder first(folder("two"), plan, "program");
    throw_missing(plan, 1, 1, first, {});
  }
  int thrown = 0;
  {
    Folder again(folder("two"), plan, "program");
    ASSERT_EQ(again.rows().size(), 1U);
    throw_missing(plan, 3, 2, again, [&](const Row&) { ++thrown; });
  }
  EXPECT_EQ(thrown, 2) << "a finished row is not thrown again";
  EXPECT_EQ(content(table("one")), content(table("two")));

  const Recalled recalled = recall(table("two") + ":2");
  EXPECT_EQ(line_of(row_of(recalled.draw, throw_stone(recalled.request, {}).result)), line_of(recalled.row));
}

TEST_F(Campaign, a_row_cut_off_by_a_kill_is_written_anew) {
  const Plan plan(practice());
  fill("killed", plan, 3);
  const std::string whole = content(table("killed"));
  for (const std::size_t lost : {1U, 10U, 60U}) {
    fs::resize_file(table("killed"), whole.size() - lost);
    fill("killed", plan, 3);
    EXPECT_EQ(content(table("killed")), whole) << lost;
  }
  fs::resize_file(table("killed"), 5);  // not even the header
  fill("killed", plan, 3);
  EXPECT_EQ(content(table("killed")), whole);
}

TEST_F(Campaign, other_options_another_rink_and_another_build_are_refused) {
  fill("mine", Plan(practice()), 1);
  refuses("mine", practice(4), "program", "another --seed: 3 there, 4 here");
  refuses("mine", practice(), "other", "another build");
  PlanText other = practice();
  other.speed_mps = {2.0, 2.0};
  refuses("mine", other, "program", "another --speed");
  other = practice();
  other.eyes = Eyes::vision;
  refuses("mine", other, "program", "another --seer");
  other = practice();
  other.scenario += "\n# changed\n";
  refuses("mine", other, "program", "another scenario");
  other = practice();
  other.rig += "\n";
  refuses("mine", other, "program", "another rig");
}

TEST_F(Campaign, a_folder_in_use_or_with_a_strange_table_is_refused) {
  const Plan plan(practice());
  {
    const Folder open(folder("mine"), plan, "program");
    refuses("mine", practice(), "program", "another program is writing");
  }
  fill("mine", plan, 2);
  std::ofstream(table("mine"), std::ios::app) << "a,b,c\n";
  refuses("mine", practice(), "program", "is no row");
  fs::create_directories(folder("strange"));
  std::ofstream(table("strange")) << "somebody's table\n";
  refuses("strange", practice(), "program", "unknown options");
}

TEST_F(Campaign, throws_that_are_not_there_are_not_recalled) {
  fill("mine", Plan(practice()), 2);
  for (const std::string& words :
       {table("mine") + ":2", table("mine") + ":", table("mine"), table("mine") + ":-1", folder("nowhere") + ":0"}) {
    EXPECT_THROW(recall(words), config::ConfigError) << words;
  }
  EXPECT_EQ(recall(folder("mine") + ":1").draw.number, 1);
}

TEST(Plan, a_throw_belongs_to_its_number_and_the_campaigns_seed) {
  const Plan plan(practice(3));
  const Plan other(practice(4));
  EXPECT_EQ(plan.draw(5).seed, Plan(practice(3)).draw(5).seed);
  EXPECT_NE(plan.draw(5).seed, plan.draw(6).seed);
  EXPECT_NE(plan.draw(5).seed, other.draw(5).seed);
  int clockwise = 0;
  for (int i = 0; i < 400; ++i) {
    const Draw draw = plan.draw(i);
    EXPECT_LT(draw.seed, 1'000'000'000'000'000'000U);
    EXPECT_GE(draw.order.speed_mps, 2.0);
    EXPECT_LE(draw.order.speed_mps, 2.6);
    clockwise += draw.order.curl == servo::Curl::clockwise ? 1 : 0;
  }
  EXPECT_NEAR(clockwise, 200, 60);
}

TEST(Plan, what_is_left_out_is_left_out_and_what_is_not_in_the_oracle_is_refused) {
  PlanText text = practice();
  text.without = Without::latency;
  EXPECT_FALSE(Plan(text).rig().looks.compensated);
  text.without = Without::visual_alignment;
  EXPECT_EQ(Plan(text).rig().thrower.alignment.method, servo::AlignmentMethod::look_then_gyro);
  text.without = Without::refraction;
  EXPECT_THROW(Plan{text}, config::ConfigError);
  text.eyes = Eyes::vision;
  EXPECT_EQ(Plan(text).rig().rig.low_camera->ice.paint_depth_m, 0.0);
}

TEST(Plan, a_shot_that_the_rig_can_not_make_is_refused) {
  PlanText text = practice();
  text.speed_mps = {2.0, 9.0};
  EXPECT_THROW(Plan{text}, config::ConfigError);
}

}  // namespace
}  // namespace hogline::campaign
