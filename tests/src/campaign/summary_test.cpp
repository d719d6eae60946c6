// What a campaign's summary counts.
#include "src/campaign/summary.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "src/campaign/plots.hpp"
#include "src/campaign/resting_plot.hpp"

namespace hogline::campaign {
namespace {

TEST(Statistics, of_known_numbers) {
  const Statistics s = statistics_of({3.0, -4.0, 1.0, 2.0, -2.0});
  EXPECT_EQ(s.count, 5);
  EXPECT_NEAR(s.mean, 0.0, 1e-12);
  EXPECT_DOUBLE_EQ(s.median, 1.0);
  EXPECT_DOUBLE_EQ(s.largest, 4.0);
  EXPECT_DOUBLE_EQ(s.rms, std::sqrt(34.0 / 5.0));
  EXPECT_DOUBLE_EQ(s.sigma, std::sqrt(34.0 / 4.0));
  EXPECT_DOUBLE_EQ(s.q05, -4.0 + 0.2 * 2.0);
}

TEST(Statistics, of_nothing_and_of_one) {
  EXPECT_EQ(statistics_of({}).count, 0);
  const Statistics one = statistics_of({-2.0});
  EXPECT_DOUBLE_EQ(one.mean, -2.0);
  EXPECT_DOUBLE_EQ(one.sigma, 0.0);
  EXPECT_DOUBLE_EQ(one.q95, -2.0);
}

std::vector<Row> three_rows() {
  std::vector<Row> rows(3);
  for (int i = 0; i < 3; ++i) rows[static_cast<std::size_t>(i)].number = i;
  rows[0].ok = rows[0].released = true;
  rows[0].place_error_mm = 5.0;
  rows[1].abort = "no frame for 155 ms";
  rows[2].abort = "no frame for 16.5 ms";
  rows[2].hog_line_violation = true;
  return rows;
}

TEST(Summary, counts_throws_and_gathers_reasons_without_their_numbers) {
  const Summary s = summarise(three_rows(), false);
  EXPECT_EQ(s.throws, 3);
  EXPECT_EQ(s.ok, 1);
  ASSERT_EQ(s.aborts.size(), 1U);
  EXPECT_EQ(s.aborts[0].what, "no frame for # ms");
  EXPECT_EQ(s.aborts[0].throws, (std::vector<int>{1, 2}));
  EXPECT_EQ(s.violations, std::vector<int>{2});
  EXPECT_EQ(s.statistics[0].count, 1);
  EXPECT_EQ(s.statistics[1].count, 0);
}

TEST(Summary, names_the_throws_that_went_wrong) {
  const std::string page = markdown(summarise(three_rows(), false));
  EXPECT_NE(page.find("no frame for # ms: 2 (1, 2)"), std::string::npos) << page;
  EXPECT_NE(page.find("Hog-line violations: 1 (2)"), std::string::npos) << page;
  EXPECT_NE(page.find("| release place | mm | 1 | 5 |"), std::string::npos) << page;
}

TEST(Summary, tells_where_tee_draws_rest) {
  auto rows = three_rows();
  rows[0].rest_x_m = 0.1;
  rows[0].rest_y_m = 34.847;
  rows[1].rest_x_m = -0.1;
  rows[1].rest_y_m = 35.047;
  const Summary s = summarise(rows, true);
  EXPECT_EQ(s.along_m.count, 2);
  EXPECT_NEAR(s.along_m.mean, 0.2, 1e-9);
  EXPECT_NEAR(s.across_m.mean, 0.0, 1e-9);
  EXPECT_NE(markdown(s).find("| along | 2 | 0.200 |"), std::string::npos) << markdown(s);
  EXPECT_GT(cv::norm(resting_places(rows), resting_places({}), cv::NORM_INF), 100.0) << "points are drawn";
}

TEST(Summary, of_no_throw_can_be_written_and_drawn) {
  EXPECT_FALSE(markdown(summarise({}, false)).empty());
  EXPECT_FALSE(json(summarise({}, false)).empty());
  EXPECT_FALSE(distributions({}).empty());
  EXPECT_FALSE(resting_places({}).empty());
}

}  // namespace
}  // namespace hogline::campaign
