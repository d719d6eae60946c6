#include "servo/assignment.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace hogline::servo::test {
namespace {

double cost_of(const std::vector<std::vector<double>>& costs, const std::vector<int>& columns) {
  double sum = 0.0;
  for (std::size_t i = 0; i < columns.size(); ++i) sum += costs[i][static_cast<std::size_t>(columns[i])];
  return sum;
}

RC_GTEST_PROP(Assignment, IsAsGoodAsTheBestOfAll, ()) {
  const auto rows = *rc::gen::inRange<std::size_t>(1, 5);
  const auto columns = rows + *rc::gen::inRange<std::size_t>(0, 3);
  std::vector<std::vector<double>> costs(rows, std::vector<double>(columns));
  for (auto& row : costs) {
    for (double& cost : row) cost = *rc::gen::inRange(-50, 50);
  }
  const std::vector<int> found = least_cost_assignment(costs);
  RC_ASSERT(std::set<int>(found.begin(), found.end()).size() == rows);
  std::vector<int> all(columns);
  std::iota(all.begin(), all.end(), 0);
  double least = 1e9;
  do {
    least = std::min(least, cost_of(costs, {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(rows)}));
  } while (std::next_permutation(all.begin(), all.end()));
  RC_ASSERT(std::abs(cost_of(costs, found) - least) < 1e-9);
}

TEST(AssignmentOfNothing, IsNothing) { EXPECT_TRUE(least_cost_assignment({}).empty()); }

}  // namespace
}  // namespace hogline::servo::test
