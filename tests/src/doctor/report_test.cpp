// The same findings for people and for machines.
#include "src/doctor/report.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace hogline::doctor {
namespace {

std::vector<Finding> some() {
  std::vector<Finding> findings(3);
  findings[0].device = "gyro";
  findings[0].line = "serial";
  findings[0].found = "100 readings a second";
  findings[0].values = {{"readings_per_s", 100.0}, {"name", std::string("KVH")}, {"count", std::int64_t{3}}};
  findings[1].device = "near camera";
  findings[1].note("dark", "unfold the arm");
  findings[2].device = "left wheel";
  findings[2].line = "CAN can0, node 1";
  findings[2].note("slow", "wait");
  findings[2].wrong("silent", "check its power");
  return findings;
}

TEST(Report, a_verdict_is_the_worst_remark) {
  const auto findings = some();
  EXPECT_EQ(findings[0].verdict(), Verdict::ok);
  EXPECT_EQ(findings[1].verdict(), Verdict::note);
  EXPECT_EQ(findings[2].verdict(), Verdict::wrong);
  EXPECT_FALSE(all_well(findings));
  EXPECT_TRUE(all_well({findings[0], findings[1]}));
}

TEST(Report, the_table_has_aligned_columns_and_what_is_wrong_before_what_is_noted) {
  const std::string text = table(some());
  EXPECT_NE(text.find("gyro         ok     serial            100 readings a second\n"), std::string::npos) << text;
  EXPECT_NE(text.find("left wheel   wrong  CAN can0, node 1"), std::string::npos) << text;
  const auto wrong = text.find("wrong: left wheel: silent\n  -> check its power");
  const auto note = text.find("note: near camera: dark\n  -> unfold the arm");
  ASSERT_NE(wrong, std::string::npos) << text;
  ASSERT_NE(note, std::string::npos) << text;
  EXPECT_LT(wrong, note);
  EXPECT_NE(text.find("1 of 3 devices"), std::string::npos);
}

TEST(Report, json_says_all_of_it_on_one_line) {
  const std::string line = json_line(some(), "rig.yaml", true);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const auto report = nlohmann::json::parse(line);
  EXPECT_EQ(report.at("ok"), false);
  EXPECT_EQ(report.at("rig"), "rig.yaml");
  EXPECT_EQ(report.at("simulated"), true);
  ASSERT_EQ(report.at("devices").size(), 3U);
  EXPECT_EQ(report.at("devices")[0].at("values").at("readings_per_s"), 100.0);
  EXPECT_EQ(report.at("devices")[0].at("values").at("count"), 3);
  EXPECT_EQ(report.at("devices")[2].at("verdict"), "wrong");
  EXPECT_EQ(report.at("devices")[2].at("remarks")[1].at("advice"), "check its power");
}

}  // namespace
}  // namespace hogline::doctor
