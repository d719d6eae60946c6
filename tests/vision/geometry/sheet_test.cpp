#include "vision/geometry/sheet.hpp"

#include <gtest/gtest.h>

namespace hogline::vision {
namespace {

TEST(Sheet, LinesLieWhereTheRulesPutThem) {
  struct Case {
    const char* line;
    double near_edge_y_m, far_edge_y_m;
  };
  const Case cases[] = {{"back_line", -1.829, -1.8163},       {"tee_line", -0.00635, 0.00635},
                        {"hog_line", 6.401, 6.5026},          {"far_hog_line", 28.2444, 28.346},
                        {"far_tee_line", 34.74065, 34.75335}, {"far_back_line", 36.5633, 36.576}};
  for (const Case& c : cases) {
    EXPECT_NEAR(cross_line(c.line).near_edge_y_m, c.near_edge_y_m, 1e-9) << c.line;
    EXPECT_NEAR(cross_line(c.line).far_edge_y_m, c.far_edge_y_m, 1e-9) << c.line;
  }
}

TEST(Sheet, IsTheSameFromBothEnds) {
  const auto lines = cross_lines();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const CrossLine& other = lines[lines.size() - 1 - i];
    EXPECT_NEAR(lines[i].near_edge_y_m, rules::tee_to_tee_m - other.far_edge_y_m, 1e-9) << lines[i].name;
  }
}

TEST(Sheet, LinesAreOrderedAndApart) {
  const auto lines = cross_lines();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    EXPECT_GT(lines[i].width_m(), 0.0);
    if (i > 0) {
      EXPECT_GT(lines[i].near_edge_y_m, lines[i - 1].far_edge_y_m);
    }
  }
}

}  // namespace
}  // namespace hogline::vision
