// The ice file: what was saved comes back to the last digit, and what can be no ice is refused.
#include "src/skip/ice_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "src/config/config_error.hpp"

namespace hogline {
namespace {

servo::IceEstimate some_ice() {
  servo::IceEstimate ice;
  ice.friction_scale = 1.0712345678901234;
  ice.curl_gain = 0.83;
  ice.lateral_mps2 = -1.25e-4;
  ice.covariance = {2.5e-5, 1e-6, 0.0, 1e-6, 4e-4, -1e-7, 0.0, -1e-7, 3e-8};
  ice.throws = 4;
  return ice;
}

TEST(IceFile, comes_back_as_it_was) {
  const std::string path = testing::TempDir() + "/ice.yaml";
  save_ice(path, some_ice());
  const auto read = load_ice(path);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->friction_scale, some_ice().friction_scale);
  EXPECT_EQ(read->curl_gain, some_ice().curl_gain);
  EXPECT_EQ(read->lateral_mps2, some_ice().lateral_mps2);
  EXPECT_EQ(read->covariance, some_ice().covariance);
  EXPECT_EQ(read->throws, 4);
  std::filesystem::remove(path);
}

TEST(IceFile, is_nothing_where_there_is_none_yet) { EXPECT_FALSE(load_ice(testing::TempDir() + "/none.yaml")); }

struct Wrong {
  const char* what;
  const char* from;
  const char* to;
  const char* key;
};
class BadIceFile : public testing::TestWithParam<Wrong> {};

TEST_P(BadIceFile, is_refused_by_name) {
  std::string text = ice_text(some_ice());
  const auto at = text.find(GetParam().from);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, std::string(GetParam().from).size(), GetParam().to);
  try {
    parse_ice(text, "sheet4.yaml");
    FAIL() << GetParam().what;
  } catch (const config::ConfigError& e) {
    EXPECT_EQ(e.file, "sheet4.yaml");
    EXPECT_EQ(e.key, GetParam().key) << e.what();
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, BadIceFile,
                         testing::Values(Wrong{"another version", "version: 1", "version: 2", "version"},
                                         Wrong{"a key too many", "throws: 4", "throws: 4\nthrow: 4", "throw"},
                                         Wrong{"a key too few", "curl_gain: 0.83\n", "", "curl_gain"},
                                         Wrong{"not a number", "throws: 4", "throws: four", "throws"},
                                         Wrong{"no friction", "1.0712345678901234", "0", "friction_scale"},
                                         Wrong{"a variance below 0", "[2.5e-05", "[-2.5e-05", "covariance"}),
                         [](const auto& c) {
                           std::string name = c.param.what;
                           for (char& letter : name) letter = letter == ' ' ? '_' : letter;
                           return name;
                         });

}  // namespace
}  // namespace hogline
