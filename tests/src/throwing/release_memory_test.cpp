#include "src/throwing/release_memory.hpp"

#include <gtest/gtest.h>

#include <unistd.h>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "src/config/config_error.hpp"

namespace hogline {
namespace {

class ReleaseMemory : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string file(const std::string& text) const {
    const std::string path = folder_ + "/jaws.json";
    std::ofstream(path) << text;
    return path;
  }
  std::string folder_ = testing::TempDir() + "release_memory_" + std::to_string(::getpid());
};

TEST_F(ReleaseMemory, keeps_what_was_learnt) {
  const servo::ReleaseKnowledge k{
      .delay_s = 0.0712, .drag_mps = 0.0041, .covariance = {1e-6, 2e-8, 2e-8, 4e-6}, .throws = 17};
  save_release_knowledge(folder_ + "/jaws.json", k);
  const auto read = load_release_knowledge(folder_ + "/jaws.json");
  ASSERT_TRUE(read);
  EXPECT_DOUBLE_EQ(read->delay_s, k.delay_s);
  EXPECT_DOUBLE_EQ(read->drag_mps, k.drag_mps);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(read->covariance[i], k.covariance[i], 1e-18);
  EXPECT_EQ(read->throws, 17);
}

TEST_F(ReleaseMemory, has_nothing_before_the_first_throw) {
  EXPECT_FALSE(load_release_knowledge(folder_ + "/none.json"));
}

TEST_F(ReleaseMemory, refuses_what_can_not_be_relied_on) {
  const std::string good = R"("gripper_delay_s":0.07,"gripper_delay_sigma_s":0.001,"drag_mps":0.004,)"
                           R"("drag_sigma_mps":0.002,"throws":3)";
  EXPECT_TRUE(load_release_knowledge(file("{" + good + R"(,"covariance_m":0})")));
  for (const std::string& text :
       {std::string(), std::string("[]"), std::string("{"), "{" + good + "}", "{" + good + R"(,"covariance_m":"x"})",
        "{" + good + R"(,"covariance_m":1e-4})", "{" + good + R"(,"covariance_m":0,"more":1})",
        std::string(R"({"gripper_delay_s":-1,"gripper_delay_sigma_s":0.001,"drag_mps":0.004,)") +
            R"("drag_sigma_mps":0.002,"covariance_m":0,"throws":3})"}) {
    EXPECT_THROW(load_release_knowledge(file(text)), config::ConfigError) << text;
  }
  EXPECT_THROW(load_release_knowledge(folder_), config::ConfigError);
}

}  // namespace
}  // namespace hogline
